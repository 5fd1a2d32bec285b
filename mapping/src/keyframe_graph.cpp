// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/keyframe_graph.h>
#include <pcl/registration/scan_preprocessing.h>

#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Points of a keyframe that are gathered before they are thinned. */
constexpr std::size_t kMostGathered = 100000;

TangentMatrix
isotropic(double translation_variance, double rotation_variance)
{
  TangentMatrix result = TangentMatrix::Zero();
  result.diagonal().head<3>().setConstant(translation_variance);
  result.diagonal().tail<3>().setConstant(rotation_variance);
  return result;
}

double
square(double x)
{
  return x * x;
}

} // namespace

KeyframeGraph::KeyframeGraph(const KeyframeGraphOptions& options,
                             std::unique_ptr<LoopDetector> detector)
    : options_(options),
      detector_(std::move(detector)),
      graph_(options.incremental),
      gate_(options.loop_probability)
{
  if (!(options.point_spacing > 0.0) || !(options.drift_translation > 0.0) ||
      !(options.drift_rotation > 0.0) || !(options.lost_translation > 0.0) ||
      !(options.lost_rotation > 0.0))
    throw std::invalid_argument("KeyframeGraph: all options must be positive");
  options.solver.validate();
}

void
KeyframeGraph::add(std::size_t scan, double stamp, const OdometryResult& odometry)
{
  if (!scans_.empty())
    growCovariance(odometry);
  last_pose_ = odometry.pose;
  if (odometry.keyframe || keyframes_.empty())
    beginKeyframe(scan, odometry);
  addPoints(odometry);
  scans_.push_back({stamp,
                    keyframes_.size() - 1,
                    keyframes_.back().T_odometry_keyframe.inverse() * odometry.pose});
}

void
KeyframeGraph::growCovariance(const OdometryResult& odometry)
{
  const Eigen::Isometry3d motion = last_pose_.inverse() * odometry.pose;
  const double length = motion.translation().norm();
  way_ += length;
  const TangentMatrix moved = adjoint(motion.inverse());
  covariance_ = moved * covariance_ * moved.transpose();
  covariance_ += odometry.tracked ? odometry.match.covariance
                                  : isotropic(square(options_.lost_translation),
                                              square(options_.lost_rotation));
}

void
KeyframeGraph::beginKeyframe(std::size_t scan, const OdometryResult& odometry)
{
  const NodeId node = keyframes_.size();
  if (keyframes_.empty()) {
    graph_.addNode(node, odometry.pose);
  }
  else {
    completeKeyframe();
    const Keyframe& last = keyframes_.back();
    const Eigen::Isometry3d T_last_new =
        orthonormal(last.T_odometry_keyframe.inverse() * odometry.pose);
    // Drift is shared by the alignments of a stretch: it grows with its length.
    const double length = way_ - last.way;
    const double least = options_.point_spacing; // a turn on the spot drifts too
    covariance_ += isotropic(square(options_.drift_translation * (length + least)),
                             square(options_.drift_rotation * (length + least)));
    graph_.addNode(node);
    const TangentMatrix information = covariance_.inverse();
    graph_.addFactor(BetweenFactor{
        last.node, node, T_last_new, 0.5 * (information + information.transpose())});
    graph_.update();
  }
  covariance_.setZero();
  keyframes_.push_back({node, scan, way_, odometry.pose, {}});
}

void
KeyframeGraph::addPoints(const OdometryResult& odometry)
{
  if (!odometry.tracked)
    return;
  Keyframe& keyframe = keyframes_.back();
  const Eigen::Isometry3f T_keyframe_scan =
      (keyframe.T_odometry_keyframe.inverse() * odometry.pose).cast<float>();
  for (const Eigen::Vector3f& point : odometry.points)
    keyframe.points.push_back(T_keyframe_scan * point);
  if (keyframe.points.size() > kMostGathered)
    keyframe.points = voxelSubsample(keyframe.points, options_.point_spacing);
}

void
KeyframeGraph::completeKeyframe()
{
  Keyframe& keyframe = keyframes_.back();
  keyframe.points = voxelSubsample(keyframe.points, options_.point_spacing);
  keyframe.points.shrink_to_fit();
  if (!detector_)
    return;
  for (const BetweenFactor& loop : detector_->detect(keyframes_, graph_.graph()))
    gate_.offer(graph_, loop);
}

void
KeyframeGraph::finish()
{
  if (!keyframes_.empty())
    completeKeyframe();
  if (!gate_.accepted().empty())
    graph_.optimizeAll(options_.solver);
}

std::vector<BetweenFactor>
KeyframeGraph::loops() const
{
  std::vector<BetweenFactor> result;
  for (const FactorId id : gate_.accepted())
    result.push_back(std::get<BetweenFactor>(graph().factor(id).measurement));
  return result;
}

Trajectory
KeyframeGraph::trajectory() const
{
  Trajectory result;
  result.reserve(scans_.size());
  for (const AttachedScan& scan : scans_)
    result.push_back(
        {scan.stamp,
         graph_.pose(keyframes_[scan.keyframe].node) * scan.T_keyframe_scan});
  return result;
}

Trajectory
KeyframeGraph::odometry() const
{
  Trajectory result;
  result.reserve(scans_.size());
  for (const AttachedScan& scan : scans_)
    result.push_back(
        {scan.stamp,
         keyframes_[scan.keyframe].T_odometry_keyframe * scan.T_keyframe_scan});
  return result;
}

} // namespace nurbs
} // namespace pcl
