// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/trajectory_metrics.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

Eigen::Matrix3Xd
positionsOf(const Trajectory& trajectory)
{
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(trajectory.size()));
  for (std::size_t k = 0; k < trajectory.size(); ++k)
    result.col(static_cast<Eigen::Index>(k)) = trajectory[k].T_world_body.translation();
  return result;
}

/** Whether positions leave the rotation about a line free. */
bool
areCollinear(const Eigen::Matrix3Xd& positions)
{
  constexpr double kThinnest = 1e-9; // width over length
  const Eigen::Matrix3Xd centred = positions.colwise() - positions.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      centred * centred.transpose(), Eigen::EigenvaluesOnly);
  return !(solver.eigenvalues()(1) > kThinnest * kThinnest * solver.eigenvalues()(2));
}

std::size_t
nearestByTime(const Trajectory& trajectory, double stamp)
{
  const auto after = std::lower_bound(
      trajectory.begin(),
      trajectory.end(),
      stamp,
      [](const StampedPose& pose, double value) { return pose.stamp < value; });
  if (after == trajectory.begin())
    return 0;
  const auto index = static_cast<std::size_t>(after - trajectory.begin());
  if (after == trajectory.end() ||
      stamp - trajectory[index - 1].stamp <= after->stamp - stamp)
    return index - 1;
  return index;
}

/** Angle of a rotation; accurate for small ones too, where the trace is not. */
double
angleOf(const Eigen::Matrix3d& rotation)
{
  return Eigen::AngleAxisd(rotation).angle();
}

/** Motion that is left of the estimate's between two poses when the reference's is
 * undone. */
Eigen::Isometry3d
motionError(const TrajectoryPair& pair, std::size_t first, std::size_t last)
{
  const auto motion = [&](const Trajectory& trajectory) {
    return trajectory[first].T_world_body.inverse() * trajectory[last].T_world_body;
  };
  return motion(pair.reference).inverse() * motion(pair.estimate);
}

/** The benchmark's own figures hang on its inverse and arc cosine in the sixth digit,
 * because the rotations of its files are orthonormal to seven digits only. */
Eigen::Matrix4d
kittiMotionError(const TrajectoryPair& pair, std::size_t first, std::size_t last)
{
  const auto motion = [&](const Trajectory& trajectory) -> Eigen::Matrix4d {
    return trajectory[first].T_world_body.matrix().inverse() *
           trajectory[last].T_world_body.matrix();
  };
  return motion(pair.estimate).inverse() * motion(pair.reference);
}

double
kittiAngle(const Eigen::Matrix4d& motion)
{
  const double cosine = 0.5 * (motion.topLeftCorner<3, 3>().trace() - 1.0);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

void
append(const Eigen::Isometry3d& error, PoseErrors& errors)
{
  errors.translation.push_back(error.translation().norm());
  errors.rotation.push_back(angleOf(error.linear()));
}

/** Where each pose is along what steps are measured in. */
std::vector<double>
placesAlong(const TrajectoryPair& pair, RelativeUnit unit)
{
  if (unit == RelativeUnit::Metres)
    return pathLengths(pair.estimate);
  std::vector<double> result;
  for (std::size_t k = 0; k < pair.reference.size(); ++k)
    result.push_back(unit == RelativeUnit::Poses ? static_cast<double>(k)
                                                 : pair.reference[k].stamp);
  return result;
}

void
requirePairs(const TrajectoryPair& pair)
{
  if (pair.reference.size() != pair.estimate.size())
    throw std::invalid_argument("trajectories: the poses are not paired");
}

} // namespace

Eigen::Isometry3d
SimilarityTransform::apply(const Eigen::Isometry3d& pose) const
{
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = rotation * pose.linear();
  result.translation() = scale * (rotation * pose.translation()) + translation;
  return result;
}

TrajectoryPair
associate(const Trajectory& reference,
          const Trajectory& estimate,
          double max_difference)
{
  TrajectoryPair result;
  const bool estimate_is_shorter = estimate.size() < reference.size();
  const Trajectory& shorter = estimate_is_shorter ? estimate : reference;
  const Trajectory& longer = estimate_is_shorter ? reference : estimate;
  if (longer.empty())
    return result;
  for (const StampedPose& pose : shorter) {
    const StampedPose& other = longer[nearestByTime(longer, pose.stamp)];
    if (!(std::abs(other.stamp - pose.stamp) <= max_difference))
      continue;
    result.reference.push_back(estimate_is_shorter ? other : pose);
    result.estimate.push_back(estimate_is_shorter ? pose : other);
  }
  return result;
}

SimilarityTransform
alignTrajectory(const TrajectoryPair& pair, TrajectoryAlignment alignment)
{
  requirePairs(pair);
  SimilarityTransform result;
  if (alignment == TrajectoryAlignment::None)
    return result;
  const Eigen::Matrix3Xd from = positionsOf(pair.estimate);
  const Eigen::Matrix3Xd to = positionsOf(pair.reference);
  if (from.cols() < 3 || areCollinear(from) || areCollinear(to))
    throw std::invalid_argument("trajectories: fewer than three pairs of poses, or all "
                                "on a line, cannot be aligned");
  const bool with_scale = alignment == TrajectoryAlignment::Sim3;
  const Eigen::Matrix4d matrix = Eigen::umeyama(from, to, with_scale);
  result.scale =
      with_scale ? std::cbrt(matrix.topLeftCorner<3, 3>().determinant()) : 1.0;
  result.rotation = matrix.topLeftCorner<3, 3>() / result.scale;
  result.translation = matrix.topRightCorner<3, 1>();
  return result;
}

Trajectory
transformed(const Trajectory& trajectory, const SimilarityTransform& transform)
{
  Trajectory result = trajectory;
  for (StampedPose& pose : result)
    pose.T_world_body = transform.apply(pose.T_world_body);
  return result;
}

ErrorStatistics
summarizeErrors(std::vector<double> errors)
{
  ErrorStatistics result;
  result.count = errors.size();
  if (errors.empty())
    return result;
  std::sort(errors.begin(), errors.end());
  const auto n = static_cast<double>(errors.size());
  for (double error : errors) {
    result.mean += error / n;
    result.sse += error * error;
  }
  double variance = 0.0;
  for (double error : errors)
    variance += (error - result.mean) * (error - result.mean) / n;
  const std::size_t half = errors.size() / 2;
  result.median =
      errors.size() % 2 == 1 ? errors[half] : 0.5 * (errors[half - 1] + errors[half]);
  result.rmse = std::sqrt(result.sse / n);
  result.std = std::sqrt(variance);
  result.min = errors.front();
  result.max = errors.back();
  return result;
}

PoseErrors
absoluteErrors(const TrajectoryPair& pair)
{
  requirePairs(pair);
  PoseErrors errors;
  for (std::size_t k = 0; k < pair.reference.size(); ++k)
    append(pair.reference[k].T_world_body.inverse() * pair.estimate[k].T_world_body,
           errors);
  return errors;
}

PoseErrors
relativeErrors(const TrajectoryPair& pair, double step, RelativeUnit unit)
{
  requirePairs(pair);
  if (!(step > 0.0) || !std::isfinite(step))
    throw std::invalid_argument("trajectories: a step must be longer than nothing");
  PoseErrors errors;
  const std::vector<double> places = placesAlong(pair, unit);
  if (places.empty())
    return errors;
  // A path's first step begins where the first step's length is complete: only then is
  // it known to begin at a border between steps. Times and counts have borders.
  std::size_t first = 0;
  bool begun = unit != RelativeUnit::Metres;
  for (std::size_t k = 1; k < places.size(); ++k) {
    if (places[k] - places[first] < step)
      continue;
    if (begun)
      append(motionError(pair, first, k), errors);
    begun = true;
    first = k;
  }
  return errors;
}

std::vector<KittiSegment>
kittiSegments(const TrajectoryPair& pair)
{
  requirePairs(pair);
  constexpr std::size_t kEvery = 10;
  constexpr int kLengths = 8;
  constexpr double kStep = 100.0; // metres
  const std::vector<double> path = pathLengths(pair.reference);
  std::vector<KittiSegment> result;
  for (std::size_t first = 0; first < path.size(); first += kEvery)
    for (int k = 1; k <= kLengths; ++k) {
      const double length = kStep * k;
      const auto end = std::upper_bound(path.begin(), path.end(), path[first] + length);
      if (end == path.end())
        break;
      KittiSegment segment;
      segment.first = first;
      segment.last = static_cast<std::size_t>(end - path.begin());
      segment.length = length;
      const Eigen::Matrix4d error = kittiMotionError(pair, first, segment.last);
      segment.translation = error.topRightCorner<3, 1>().norm() / length;
      segment.rotation = kittiAngle(error) / length;
      result.push_back(segment);
    }
  return result;
}

KittiErrors
meanErrors(const std::vector<KittiSegment>& segments, double length)
{
  KittiErrors result;
  for (const KittiSegment& segment : segments)
    if (length == 0.0 || segment.length == length) {
      ++result.segments;
      result.translation += segment.translation;
      result.rotation += segment.rotation;
    }
  if (result.segments > 0) {
    result.translation /= static_cast<double>(result.segments);
    result.rotation /= static_cast<double>(result.segments);
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
