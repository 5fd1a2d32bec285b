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
/** Beams as far apart have nothing in common: 8 degrees at the horizon. */
constexpr std::size_t kNeighbourhood = 80;
/** Errors are at least such a share of those expected, to be squared and inverted. */
constexpr double kLeastShare = 1e-3;
/** Added where a sum of weights, which go up to one, may be nothing. */
constexpr double kTiny = 1e-9;

BeamCalibration::Beam
beamAt(double sine)
{
  const double known = std::isfinite(sine) ? sine : 0.0;
  const double place = (0.5 * known + 0.5) * kBeams;
  return static_cast<BeamCalibration::Beam>(
      std::clamp(place, 0.0, static_cast<double>(kBeams - 1)));
}

/** By columns, how a reading moves with an error of its range, elevation, azimuth. */
Eigen::Matrix3d
errorDirections(const Eigen::Vector3d& point)
{
  const double range = point.norm();
  const double level = point.head<2>().norm();
  Eigen::Matrix3d directions = Eigen::Matrix3d::Zero();
  if (!(range > 0.0 && std::isfinite(range)))
    return directions;
  directions.col(0) = point / range;
  if (!(level > 0.0)) // straight up or down angles mean nothing
    return directions;
  const double steepness = point.z() / level;
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
           const Eigen::Vector3d& place,
           const Eigen::Vector3d& measured,
           const Eigen::Matrix3d& rotation,
           double most)
{
  const auto nearest = map.nearest(place, map.options().voxel_size);
  if (!nearest)
    return std::nullopt;
  const LocalSurface surface = localSurface(map.surface(*nearest));
  const double distance = surface.normal.dot(place - surface.mean);
  if (!surface.flat() || !(std::abs(distance) <= most))
    return std::nullopt;
  // What the sensor turns within a scan hardly changes the directions.
  const Eigen::Vector3d normal = rotation.transpose() * surface.normal;
  return Residual{distance, errorDirections(measured).transpose() * normal};
}

/** Variances of what is expected. */
Eigen::Array3d
varianceOf(const BeamError& expected)
{
  return Eigen::Array3d(expected.range, expected.elevation, expected.azimuth).square();
}

/** For each beam the sum over those in its neighbourhood. O(beams) */
std::vector<Eigen::Array3d>
sumsOfNeighbours(const std::vector<Eigen::Array3d>& values)
{
  std::vector<Eigen::Array3d> before(kBeams + 1, Eigen::Array3d::Zero());
  for (std::size_t i = 0; i < kBeams; ++i)
    before[i + 1] = before[i] + values[i];
  std::vector<Eigen::Array3d> sums(kBeams);
  for (std::size_t i = 0; i < kBeams; ++i)
    sums[i] = before[std::min(i + kNeighbourhood + 1, kBeams)] -
              before[i - std::min(i, kNeighbourhood)];
  return sums;
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
    if (!(value > 1e-12 && value < 1e12))
      throw std::invalid_argument("BeamCalibration: deviations must be positive");
  if (!(options.way >= 0.0))
    throw std::invalid_argument("BeamCalibration: the way must not be negative");
}

void
check(const ScanPoints& points, const std::vector<BeamCalibration::Beam>& beams)
{
  if (beams.size() != points.size() ||
      std::any_of(beams.begin(), beams.end(), [](auto beam) { return beam >= kBeams; }))
    throw std::invalid_argument("BeamCalibration: one beam per point is needed");
}

} // namespace

BeamCalibration::BeamCalibration(const BeamCalibrationOptions& options)
    : options_(options), beams_(kBeams)
{
  check(options);
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
  check(points, beams);
  for (std::size_t i = 0; any_ && i < points.size(); ++i) {
    const Eigen::Vector3d point = points[i].cast<double>();
    points[i] = (point - errorDirections(point) * beams_[beams[i]].error).cast<float>();
  }
}

void
BeamCalibration::learn(const VoxelMap& map,
                       const ScanPoints& points,
                       const ScanPoints& measured,
                       const std::vector<Beam>& beams,
                       const Eigen::Isometry3d& pose,
                       int threads)
{
  check(measured, beams);
  if (points.size() != measured.size() || threads < 1)
    throw std::invalid_argument("BeamCalibration: one measured point per point, and at "
                                "least one thread, are needed");
  const double way = (pose.translation() - learned_at_).norm();
  if (!pose.matrix().allFinite() || (any_ && way < options_.way))
    return;
  std::vector<std::optional<Residual>> residuals(points.size());
  forChunks(
      points.size(), threads, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
          residuals[i] = residualOf(map,
                                    pose * points[i].cast<double>(),
                                    measured[i].cast<double>(),
                                    pose.linear(),
                                    options_.max_residual);
      });
  if (std::none_of(residuals.begin(), residuals.end(), [](const auto& residual) {
        return residual.has_value();
      }))
    return;
  learned_at_ = pose.translation();
  any_ = true;
  forgetSome();
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
  const Eigen::Array3d expected = varianceOf(options_.expected);
  const Eigen::Array3d spread = solveWith(expected);
  solveWith(spread.min(expected).max(kLeastShare * kLeastShare * expected));
}

Eigen::Array3d
BeamCalibration::solveWith(const Eigen::Array3d& variance)
{
  // How much of a beam's error is known, from 0 to 1, says how much it counts for what
  // its neighbourhood shares, and how much of that is taken out of it.
  const Eigen::Array3d prior = variance.inverse();
  const Eigen::Matrix3d prior_matrix = prior.matrix().asDiagonal();
  std::vector<Eigen::Array3d> known(kBeams);
  std::vector<Eigen::Array3d> weights(kBeams);
  std::vector<Eigen::Array3d> shared(kBeams);
  for (std::size_t i = 0; i < kBeams; ++i) {
    Learned& beam = beams_[i];
    const Eigen::Array3d information = beam.matrix.diagonal();
    known[i] = information / (information + prior);
    weights[i] = known[i].square();
    if (!beam.matrix.isZero(0.0))
      beam.error = (beam.matrix + prior_matrix).ldlt().solve(beam.right);
    shared[i] = known[i] * beam.error.array();
  }
  weights = sumsOfNeighbours(weights);
  shared = sumsOfNeighbours(shared);
  Eigen::Array3d squares = Eigen::Array3d::Zero();
  Eigen::Array3d freedoms = Eigen::Array3d::Constant(kTiny);
  for (std::size_t i = 0; i < kBeams; ++i) {
    if (beams_[i].matrix.isZero(0.0))
      continue;
    const Eigen::Array3d total = weights[i] + kTiny;
    Eigen::Vector3d& error = beams_[i].error;
    error -= (known[i] * shared[i] / total).matrix();
    squares += (known[i] * error.array()).square();
    freedoms += known[i].pow(4) * (1.0 - known[i].square() / total);
  }
  return squares / freedoms;
}

BeamError
BeamCalibration::error(double elevation) const
{
  const Eigen::Vector3d& error = beams_[beamAt(std::sin(elevation))].error;
  return {error[0], error[1], error[2]};
}

} // namespace nurbs
} // namespace pcl
