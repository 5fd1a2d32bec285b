// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/trajectory.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief What is fitted to the estimate before it is compared. */
enum class TrajectoryAlignment {
  None, /**< both are in the same frame */
  SE3,  /**< a rigid motion */
  Sim3  /**< a rigid motion and a scale, for a single camera */
};

/** \brief x -> scale * rotation * x + translation. */
struct PCL_NURBS_MAPPING_EXPORT SimilarityTransform {
  double scale = 1.0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  /** \brief A pose whose position is scaled and moved and whose axes are turned. */
  Eigen::Isometry3d
  apply(const Eigen::Isometry3d& pose) const;
};

/** \brief Two trajectories with a pose of each at the same times. */
struct TrajectoryPair {
  Trajectory reference;
  Trajectory estimate;
};

/** \brief Pair the poses of two trajectories by their stamps: each pose of the one with
 * fewer poses takes the nearest of the other one.
 * \param[in] reference, estimate by time
 * \param[in] max_difference farther poses are no pair (seconds)
 * \return pairs by time, perhaps none. O(n log m) */
PCL_NURBS_MAPPING_EXPORT TrajectoryPair
associate(const Trajectory& reference,
          const Trajectory& estimate,
          double max_difference = 0.01);

/** \brief The similarity that brings the estimate's positions nearest to the
 * reference's in the least-squares sense (Umeyama, PAMI 1991).
 * \throws std::invalid_argument with fewer than three pairs, or positions on a line:
 * the rotation is then not determined */
PCL_NURBS_MAPPING_EXPORT SimilarityTransform
alignTrajectory(const TrajectoryPair& pair, TrajectoryAlignment alignment);

/** \brief The estimate moved by a similarity. */
PCL_NURBS_MAPPING_EXPORT Trajectory
transformed(const Trajectory& trajectory, const SimilarityTransform& transform);

/** \brief Of a list of errors; std is that of the population. */
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;
  double std = 0.0;
  double min = 0.0;
  double max = 0.0;
  double sse = 0.0; /**< sum of squares */
};

/** \brief Statistics of a list; all zero for an empty one. */
PCL_NURBS_MAPPING_EXPORT ErrorStatistics
summarizeErrors(std::vector<double> errors);

/** \brief Errors of poses or of motions: translation in metres, rotation in radians. */
struct PoseErrors {
  std::vector<double> translation;
  std::vector<double> rotation;
};

/** \brief Absolute pose errors, one per pair; align first. */
PCL_NURBS_MAPPING_EXPORT PoseErrors
absoluteErrors(const TrajectoryPair& pair);

/** \brief What relative errors are taken over. */
enum class RelativeUnit {
  Poses,  /**< so many poses later */
  Metres, /**< so much of the estimate's path later */
  Seconds /**< so much later by the reference's stamps */
};

/** \brief Relative pose errors over consecutive, not overlapping steps (Sturm et al.,
 * IROS 2012): the motion that is left between the estimate's and the reference's.
 * \param[in] step length of a step, > 0
 * \throws std::invalid_argument for a step that is not positive */
PCL_NURBS_MAPPING_EXPORT PoseErrors
relativeErrors(const TrajectoryPair& pair, double step, RelativeUnit unit);

/** \brief One sub-sequence of KITTI's odometry metric. */
struct KittiSegment {
  std::size_t first = 0;
  std::size_t last = 0;
  double length = 0.0;      /**< nominal, metres */
  double translation = 0.0; /**< error over length, metres per metre */
  double rotation = 0.0;    /**< error over length, radians per metre */
};

/** \brief The sub-sequences of 100, 200 .. 800 m of the KITTI odometry benchmark
 * (Geiger et al., CVPR 2012), one from every tenth pose: it ends with the first pose
 * that is farther along the reference's path. None for a drive of less than 100 m. */
PCL_NURBS_MAPPING_EXPORT std::vector<KittiSegment>
kittiSegments(const TrajectoryPair& pair);

/** \brief Means over segments. */
struct KittiErrors {
  std::size_t segments = 0;
  double translation = 0.0; /**< metres per metre */
  double rotation = 0.0;    /**< radians per metre */
};

/** \brief Mean over segments, of one nominal length or, with 0, of all. */
PCL_NURBS_MAPPING_EXPORT KittiErrors
meanErrors(const std::vector<KittiSegment>& segments, double length = 0.0);

} // namespace nurbs
} // namespace pcl
