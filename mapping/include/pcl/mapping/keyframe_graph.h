// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/loop_detector.h>
#include <pcl/mapping/loop_gate.h>
#include <pcl/mapping/trajectory.h>
#include <pcl/registration/scan_odometry.h>

#include <memory>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Parameters of KeyframeGraph; metres and radians. */
struct KeyframeGraphOptions {
  /** One point per voxel of this size is kept of a keyframe. */
  double point_spacing = 0.8;
  /** What odometry drifts per metre beside the noise of its alignments, which say
   * nothing of errors that they have in common. */
  double drift_translation = 0.01;
  double drift_rotation = 2e-4;
  /** Standard deviations of the motion of a scan that could not be aligned. */
  double lost_translation = 1.0;
  double lost_rotation = 0.1;
  /** Share of true loops that should agree with the graph at once, see LoopGate. */
  double loop_probability = 0.99;
  IncrementalOptions incremental;
  PoseGraphOptions solver; /**< at the end of the drive */
};

/** \brief The third stage of a pipeline: keyframes become nodes of a pose graph,
 * odometry and loops its factors, and scans move with their keyframes.
 *
 * The covariance of the odometry between two keyframes is the sum of those of the
 * alignments in between and of its drift. A loop costs the part of the graph that it
 * touches; one that contradicts the graph is held back until others confirm it. The
 * whole graph is optimised at the end. Not to be called from several threads at a time. \ingroup mapping */
class PCL_NURBS_MAPPING_EXPORT KeyframeGraph {
public:
  /** \param[in] detector finds loops; null for none
   * \throws std::invalid_argument for options that make no sense */
  KeyframeGraph(const KeyframeGraphOptions& options,
                std::unique_ptr<LoopDetector> detector);

  /** \brief Add the next scan. O(points), and what the detector and the solver need
   * when a keyframe is complete */
  void
  add(std::size_t scan, double stamp, const OdometryResult& odometry);

  /** \brief The drive is over: the last keyframe is complete, the graph is optimised.
   */
  void
  finish();

  /** \brief Pose of each scan by the graph as it is. O(scans) */
  Trajectory
  trajectory() const;

  /** \brief Pose of each scan by odometry alone. O(scans) */
  Trajectory
  odometry() const;

  /** \brief With the loops that were let in. */
  const PoseGraph&
  graph() const
  {
    return graph_.graph();
  }

  const std::vector<Keyframe>&
  keyframes() const
  {
    return keyframes_;
  }

  /** \brief Loops that are factors of the graph. */
  std::vector<BetweenFactor>
  loops() const;

  /** \brief Loops that contradict the graph. */
  const std::vector<HeldLoop>&
  heldLoops() const
  {
    return gate_.held();
  }

private:
  /** A scan as its keyframe sees it. */
  struct AttachedScan {
    double stamp = 0.0;
    std::size_t keyframe = 0;
    Eigen::Isometry3d T_keyframe_scan = Eigen::Isometry3d::Identity();
  };

  /** Covariance of the motion since the last keyframe, extended by a scan's. */
  void
  growCovariance(const OdometryResult& odometry);

  void
  beginKeyframe(std::size_t scan, const OdometryResult& odometry);

  void
  addPoints(const OdometryResult& odometry);

  void
  completeKeyframe();

  KeyframeGraphOptions options_;
  std::unique_ptr<LoopDetector> detector_;
  IncrementalPoseGraph graph_;
  LoopGate gate_;
  std::vector<Keyframe> keyframes_;
  std::vector<AttachedScan> scans_;
  Eigen::Isometry3d last_pose_ = Eigen::Isometry3d::Identity();
  double way_ = 0.0;
  TangentMatrix covariance_ = TangentMatrix::Zero();
};

} // namespace nurbs
} // namespace pcl
