// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/registration/beam_calibration.h>

#include "chunked_sum.h"
#include "local_surface.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

/** Intervals of the sine of the elevation, from -1 to 1: 0.1 degrees at the horizon. */
constexpr std::size_t kBeams = 1146;

BeamCalibration::Beam
beamAt(double sine)
{
  const double place = (0.5 * sine + 0.5) * kBeams;
  return static_cast<BeamCalibration::Beam>(
      std::clamp(place, 0.0, static_cast<double>(kBeams - 1)));
}

/** By columns, how a reading moves with an error of its range, elevation, azimuth. */
Eigen::Matrix3d
errorDirections(const Eigen::Vector3d& point)
{
  const double level = point.head<2>().norm();
  Eigen::Matrix3d directions = Eigen::Matrix3d::Zero();
  if (!(level > 0.0)) // straight up or down angles mean nothing
    return directions;
  const double steepness = point.z() / level;
  directions.col(0) = point / point.norm();
  directions.col(1) << -steepness * point.x(), -steepness * point.y(), level;
  directions.col(2) << -point.y(), point.x(), 0.0;
  return directions;
}

/** A point's distance from its surface, and what a beam's errors add to it. */
struct Residual {
  double distance;
  Eigen::Vector3d slope;
};

std::optional<Residual>
residualOf(const VoxelMap& map,
           const Eigen::Vector3d& point,
           const Eigen::Isometry3d& pose,
           double most)
{
  const Eigen::Vector3d place = pose * point;
  const auto nearest = map.nearest(place, map.options().voxel_size);
  if (!nearest)
    return std::nullopt;
  const LocalSurface surface = localSurface(map.surface(*nearest));
  const double distance = surface.normal.dot(place - surface.mean);
  if (!surface.flat() || !(std::abs(distance) <= most))
    return std::nullopt;
  const Eigen::Vector3d normal = pose.linear().transpose() * surface.normal;
  return Residual{distance, errorDirections(point).transpose() * normal};
}

void
check(const BeamCalibrationOptions& options)
{
  const BeamError& expected = options.expected;
  for (const double value : {expected.range,
                             expected.elevation,
                             expected.azimuth,
                             options.residual_deviation,
                             options.max_residual,
                             options.memory})
    if (!(value > 0.0))
      throw std::invalid_argument("BeamCalibration: deviations must be positive");
  if (!(options.way >= 0.0))
    throw std::invalid_argument("BeamCalibration: the way must not be negative");
}

} // namespace

BeamCalibration::BeamCalibration(const BeamCalibrationOptions& options)
    : options_(options), beams_(kBeams)
{
  check(options);
  const BeamError& expected = options.expected;
  prior_ = Eigen::Array3d(expected.range, expected.elevation, expected.azimuth)
               .square()
               .inverse();
}

std::vector<BeamCalibration::Beam>
BeamCalibration::beamsOf(const ScanPoints& points)
{
  std::vector<Beam> beams;
  beams.reserve(points.size());
  for (const Eigen::Vector3f& point : points)
    beams.push_back(beamAt(static_cast<double>(point.z() / point.norm())));
  return beams;
}

void
BeamCalibration::correct(ScanPoints& points, const std::vector<Beam>& beams) const
{
  for (std::size_t i = 0; any_ && i < points.size(); ++i) {
    const Eigen::Vector3d point = points[i].cast<double>();
    points[i] = (point - errorDirections(point) * beams_[beams[i]].error).cast<float>();
  }
}

void
BeamCalibration::learn(const VoxelMap& map,
                       const ScanPoints& points,
                       const std::vector<Beam>& beams,
                       const Eigen::Isometry3d& pose,
                       int threads)
{
  if (beams.size() != points.size())
    throw std::invalid_argument("BeamCalibration: one beam per point is needed");
  if (any_ && (pose.translation() - learned_at_).norm() < options_.way)
    return;
  learned_at_ = pose.translation();
  any_ = true;
  forgetSome();
  std::vector<std::optional<Residual>> residuals(points.size());
  forChunks(
      points.size(), threads, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
          residuals[i] =
              residualOf(map, points[i].cast<double>(), pose, options_.max_residual);
      });
  const double weight = std::pow(options_.residual_deviation, -2);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!residuals[i])
      continue;
    const Eigen::Vector3d& slope = residuals[i]->slope;
    Learned& beam = beams_[beams[i]];
    // Of the reading as it was: what has been taken out is part of its error.
    const double whole = residuals[i]->distance + slope.dot(beam.error);
    beam.matrix += weight * slope * slope.transpose();
    beam.right += weight * whole * slope;
    beam.any = true;
  }
  solve();
}

void
BeamCalibration::forgetSome()
{
  const double kept = std::exp(-1.0 / options_.memory);
  for (Learned& beam : beams_) {
    beam.matrix *= kept;
    beam.right *= kept;
  }
}

void
BeamCalibration::solve()
{
  // A beam counts for the mean as much as its error is known.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d weights = Eigen::Vector3d::Constant(1e-12);
  for (Learned& beam : beams_) {
    if (!beam.any)
      continue;
    const Eigen::Vector3d known = beam.matrix.diagonal();
    const Eigen::Vector3d weight = known.cwiseQuotient(known + prior_);
    const Eigen::Matrix3d prior = prior_.asDiagonal();
    beam.error = (beam.matrix + prior).ldlt().solve(beam.right);
    sum += weight.cwiseProduct(beam.error);
    weights += weight;
  }
  for (Learned& beam : beams_)
    if (beam.any)
      beam.error -= sum.cwiseQuotient(weights);
}

BeamError
BeamCalibration::error(double elevation) const
{
  const Eigen::Vector3d& error = beams_[beamAt(std::sin(elevation))].error;
  return {error[0], error[1], error[2]};
}

} // namespace nurbs
} // namespace pcl
