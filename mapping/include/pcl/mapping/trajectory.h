// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Where a body was, and when.
 * \ingroup mapping */
struct StampedPose {
  /** Seconds, of any clock; the number of the pose where no times are known. */
  double stamp = 0.0;
  /** From the body's frame (a sensor, a vehicle) to the world's, metres. */
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
};

/** \brief Poses of one body by time; two may have the same.
 * \ingroup mapping */
using Trajectory = std::vector<StampedPose>;

/** \brief Read a trajectory in KITTI's format (the 12 numbers of [R | t] by rows, one
 * pose a line) or TUM's (stamp tx ty tz qx qy qz qw); the number of columns tells
 * which.
 *
 * Lines that begin with '#' and empty ones are skipped. Rotations stay as written, so
 * those of KITTI are orthonormal to the digits of the file only; one that is off by
 * more than 1e-3 is an error, as are numbers that are not finite and, with stamps,
 * times that do not increase. \param[in] path file \param[in] times_path file with one
 * stamp a line for a KITTI file, empty for none: stamps then count poses \return at
 * least one pose \throws InputError naming file, line and reason */
PCL_NURBS_MAPPING_EXPORT Trajectory
readTrajectory(const std::string& path, const std::string& times_path = {});

/** \brief Write in KITTI's format, 9 digits after the point.
 * \throws std::runtime_error "cannot write PATH: reason" */
PCL_NURBS_MAPPING_EXPORT void
writeKittiTrajectory(const std::string& path, const Trajectory& trajectory);

/** \brief Write in TUM's format, 9 digits after the point.
 * \throws std::runtime_error "cannot write PATH: reason" */
PCL_NURBS_MAPPING_EXPORT void
writeTumTrajectory(const std::string& path, const Trajectory& trajectory);

/** \brief Pose at a time, by even motion between the two poses around it; beyond the
 * ends, the first or last pose.
 * \param[in] trajectory by time, not empty. O(log n)
 * \throws std::invalid_argument for an empty one */
PCL_NURBS_MAPPING_EXPORT StampedPose
poseAt(const Trajectory& trajectory, double time);

/** \brief Length driven up to each pose, metres; 0 for the first. */
PCL_NURBS_MAPPING_EXPORT std::vector<double>
pathLengths(const Trajectory& trajectory);

} // namespace nurbs
} // namespace pcl
