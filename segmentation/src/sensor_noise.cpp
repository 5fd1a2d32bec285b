// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/sensor_noise.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl {
namespace {

using nurbs::GridPoints;

constexpr int kBins = 16;
constexpr std::size_t kEnough = 200; // samples that make the median of a bin useful
constexpr double kMedianToSigma = 1.4826;

struct Bin {
  std::vector<float> depths;
  std::vector<float> deviations; // depth units, |second difference| / sqrt(6)
  std::vector<float> steps;      // between next neighbours of different depth
  std::size_t ties = 0;          // next neighbours of the same depth
};

double
median(std::vector<float>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Depth deviation of the middle of three samples from their common line. */
float
deviation(const GridPoints& points, std::size_t middle, std::size_t step, bool inverse)
{
  const float before = points.depth[middle - step];
  const float here = points.depth[middle];
  const float after = points.depth[middle + step];
  const float bend = inverse
                         ? here * here * (1.0F / before - 2.0F / here + 1.0F / after)
                         : before - 2.0F * here + after;
  return std::abs(bend) / std::sqrt(6.0F);
}

std::vector<float>
validDepths(const GridPoints& points)
{
  std::vector<float> depths;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.valid(i))
      depths.push_back(points.depth[i]);
  return depths;
}

std::vector<Bin>
collectBins(const GridPoints& points, float nearest, float farthest)
{
  const auto projection = points.geometry.projection;
  const bool inverse = projection == GridProjection::perspective ||
                       projection == GridProjection::spherical;
  const std::size_t step = projection == GridProjection::perspective ? 4 : 1;
  const auto width = static_cast<std::size_t>(points.geometry.width);
  const float scale = kBins / std::max(farthest - nearest, 1e-6F);
  std::vector<Bin> bins(kBins);
  for (std::size_t first = 0; first + width <= points.size(); first += width)
    for (std::size_t i = first + step; i + step < first + width; ++i) {
      const float value = deviation(points, i, step, inverse);
      if (std::isnan(value))
        continue;
      const float where = (points.depth[i] - nearest) * scale;
      Bin& bin = bins[static_cast<std::size_t>(std::clamp(where, 0.0F, kBins - 1.0F))];
      bin.depths.push_back(points.depth[i]);
      bin.deviations.push_back(value);
      const float change = std::abs(points.depth[i + 1] - points.depth[i]);
      if (change > 0.0F)
        bin.steps.push_back(change);
      else if (change == 0.0F)
        ++bin.ties;
    }
  return bins;
}

/** Deviation of a bin. Depths that come in steps often tie; most of their second
 * differences vanish although each errs by up to half a step. */
double
sigmaOf(Bin& bin)
{
  const double spread = kMedianToSigma * median(bin.deviations);
  if (bin.steps.empty() || bin.ties < bin.steps.size() / 4)
    return spread;
  return std::hypot(spread, median(bin.steps) / std::sqrt(12.0));
}

/** Weighted line sigma = a + b depth^2 through the bins, neither term negative. */
SensorNoise
fitBins(std::vector<Bin>& bins, double fallback)
{
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (Bin& bin : bins) {
    if (bin.deviations.size() < kEnough)
      continue;
    const double depth = median(bin.depths);
    const double sigma = sigmaOf(bin);
    const Eigen::Vector2d row(1.0, depth * depth);
    // Relative errors count, so that near bins are not drowned by far ones.
    const double weight = std::sqrt(static_cast<double>(bin.deviations.size())) /
                          std::max(sigma * sigma, 1e-12);
    normal += weight * row * row.transpose();
    right += weight * sigma * row;
  }
  if (normal(0, 0) == 0.0)
    return {fallback, 0.0, 0.0};
  const Eigen::Vector2d both = normal.fullPivLu().solve(right);
  if (both.y() < 0.0 || !both.allFinite())
    return {right(0) / normal(0, 0), 0.0, 0.0};
  if (both.x() < 0.0)
    return {0.0, right(1) / normal(1, 1), 0.0};
  return {both.x(), both.y(), 0.0};
}

} // namespace

SensorNoise
SensorNoise::kinect()
{
  return {0.0012, 0.0019, 0.4};
}

SensorNoise
SensorNoise::hdl64()
{
  return {0.02, 0.0, 0.0};
}

SensorNoise
SensorNoise::estimate(const GridPoints& points)
{
  std::vector<float> depths = validDepths(points);
  if (depths.empty())
    return {};
  const double typical = std::abs(median(depths));
  const auto [nearest, farthest] = std::minmax_element(depths.begin(), depths.end());
  std::vector<Bin> bins = collectBins(points, *nearest, *farthest);
  return fitBins(bins, 0.001 * typical);
}

} // namespace pcl
