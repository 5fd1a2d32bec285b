// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/trajectory.h>

#include <filesystem>
#include <optional>
#include <vector>

namespace pcl {
namespace nurbs {

/** Place and attitude of the vehicle in a file of KITTI's raw data. */
struct OxtsRecord {
  double latitude = 0.0;  /**< degrees */
  double longitude = 0.0; /**< degrees */
  double altitude = 0.0;  /**< metres */
  double roll = 0.0;      /**< about x (ahead), radians */
  double pitch = 0.0;     /**< about y (left), radians */
  double yaw = 0.0;       /**< about z (up), 0 is east, radians */
};

/** \throws InputError naming the file */
OxtsRecord
readOxts(const std::filesystem::path& file);

/** Pose of the inertial unit in a frame east, north, up on a Mercator map that is true
 * to scale at a latitude (degrees), as KITTI's development kit defines it. */
Eigen::Isometry3d
poseOnMap(const OxtsRecord& record, double scale_latitude);

} // namespace nurbs
} // namespace pcl
