// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>
#include <pcl/mapping/trajectory.h>

#include <string>

namespace pcl {
namespace nurbs {

/** \file
 * Frames of KITTI. Its poses are of the left camera (x right, y down, z ahead) in the
 * frame of that camera at the first scan. With Tr, which goes from the laser to the
 * camera, the poses of the laser (x ahead, y left, z up) in the frame of the laser at
 * the first scan are Tr^-1 T Tr.
 */

/** \brief The motion from the laser to the left camera: the line "Tr:" of an odometry
 * calib.txt, or R and T of calib_velo_to_cam.txt in the raw layout.
 * \throws InputError when the file has neither or they are no rigid motion
 * \ingroup mapping */
PCL_NURBS_MAPPING_EXPORT Eigen::Isometry3d
readKittiCalibration(const std::string& path);

/** \brief The axes of laser and camera without any mounting error, for poses that come
 * without a calibration: the camera 0.08 m below and 0.27 m ahead. */
PCL_NURBS_MAPPING_EXPORT Eigen::Isometry3d
nominalKittiCalibration();

/** \brief Poses of the camera as poses of the laser: Tr^-1 T Tr. */
PCL_NURBS_MAPPING_EXPORT Trajectory
inLaserFrame(Trajectory camera_poses, const Eigen::Isometry3d& T_camera_laser);

} // namespace nurbs
} // namespace pcl
