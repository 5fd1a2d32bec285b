// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/sensor_noise.h>

#include "noise_bins.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

namespace pcl {
namespace {

using nurbs::GridPoints;
using nurbs::NoiseBin;

constexpr std::size_t kEnough = 200; // samples that make the median of a bin useful

/** Part of the absolute deviations that is surely noise. */
struct Share {
  double quantile;
  double to_sigma; // for normally distributed noise
};

constexpr Share kHalf{0.5, 1.4826};
/** Scattered samples of plants and clutter may well be the majority. */
constexpr Share kQuarter{0.25, 3.1381};

double
quantile(std::vector<float>& values, double share)
{
  const auto where = values.begin() + static_cast<std::ptrdiff_t>(
                                          share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), where, values.end());
  return *where;
}

std::vector<float>
validDepths(const GridPoints& points)
{
  std::vector<float> depths;
  depths.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.valid(i))
      depths.push_back(points.depth[i]);
  return depths;
}

/** Deviations of a bin along rows and along columns; nothing when there are too few
 * samples. */
using Spread = std::array<std::optional<double>, 2>;

std::vector<Spread>
spreadsOf(std::vector<NoiseBin>& bins, const Share& share, int threads)
{
  std::vector<Spread> spreads(bins.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::size_t k = 0; k < 2 * bins.size(); ++k) {
    std::vector<float>& deviations = bins[k / 2].deviations[k % 2];
    if (deviations.size() >= kEnough)
      spreads[k / 2][k % 2] = share.to_sigma * quantile(deviations, share.quantile);
  }
  return spreads;
}

/** What the deviations along columns have in excess of those along rows, at least,
 * in any bin that holds many. Rings of a laser are aligned to each other to so much
 * only; farther away, where rings lie apart and graze the ground, errors of their angle
 * and the roughness of the scene add to it. */
double
excessAlongColumns(const std::vector<NoiseBin>& bins,
                   const std::vector<Spread>& spreads)
{
  std::size_t samples = 0;
  for (const NoiseBin& bin : bins)
    samples += bin.deviations[1].size();
  std::optional<double> least;
  for (std::size_t k = 0; k < bins.size(); ++k) {
    if (20 * bins[k].deviations[1].size() < samples)
      continue; // too few to be relied on alone
    const auto& [row, column] = spreads[k];
    if (!row || !column)
      continue;
    const double excess = std::sqrt(std::max(0.0, *column * *column - *row * *row));
    least = std::min(excess, least.value_or(excess));
  }
  return least.value_or(0.0);
}

/** Deviation of a bin. Depths that come in steps often tie; most of their second
 * differences vanish although each errs by up to half a step. */
double
sigmaOf(NoiseBin& bin, const Spread& own, double excess)
{
  const double spread = std::hypot(own[0].value_or(0.0), excess);
  if (bin.steps.empty() || bin.ties < bin.steps.size() / 4)
    return spread;
  return std::hypot(spread, quantile(bin.steps, 0.5) / std::sqrt(12.0));
}

/** Weighted line sigma = a + b depth^2 through the bins, neither term negative; nothing
 * when no bin has enough samples. */
std::optional<SensorNoise>
fitBins(std::vector<NoiseBin>& bins, const Share& share, int threads)
{
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  const std::vector<Spread> spreads = spreadsOf(bins, share, threads);
  const double excess = excessAlongColumns(bins, spreads);
  for (std::size_t k = 0; k < bins.size(); ++k) {
    NoiseBin& bin = bins[k];
    const std::size_t samples = bin.deviations[0].size();
    if (samples < kEnough)
      continue;
    // Without depths it is the only bin, which says nothing about a slope.
    const double depth = bin.depths.empty() ? 0.0 : quantile(bin.depths, 0.5);
    const double sigma = sigmaOf(bin, spreads[k], excess);
    const Eigen::Vector2d row(1.0, depth * depth);
    // Relative errors count, so that near bins are not drowned by far ones.
    const double weight =
        std::sqrt(static_cast<double>(samples)) / std::max(sigma * sigma, 1e-12);
    normal += weight * row * row.transpose();
    right += weight * sigma * row;
  }
  if (normal(0, 0) == 0.0)
    return std::nullopt;
  if (bins.size() == 1)
    return SensorNoise{right(0) / normal(0, 0), 0.0, 0.0};
  const Eigen::Vector2d both = normal.fullPivLu().solve(right);
  if (both.y() < 0.0 || !both.allFinite())
    return SensorNoise{right(0) / normal(0, 0), 0.0, 0.0};
  if (both.x() < 0.0)
    return SensorNoise{0.0, right(1) / normal(1, 1), 0.0};
  return SensorNoise{both.x(), both.y(), 0.0};
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
SensorNoise::estimate(const GridPoints& points, int threads)
{
  if (threads < 1)
    throw std::invalid_argument("SensorNoise: there must be a thread");
  std::vector<float> depths = validDepths(points);
  if (depths.empty())
    return {};
  const auto [nearest, farthest] = std::minmax_element(depths.begin(), depths.end());
  std::vector<NoiseBin> bins = nurbs::sampleNoise(points, *nearest, *farthest, threads);
  const bool scattered = points.geometry.max_gap > 1 && points.geometry.row_v.empty();
  const std::optional<SensorNoise> fitted =
      fitBins(bins, scattered ? kQuarter : kHalf, threads);
  if (fitted)
    return *fitted;
  return {0.001 * std::abs(quantile(depths, 0.5)), 0.0, 0.0};
}

} // namespace pcl
