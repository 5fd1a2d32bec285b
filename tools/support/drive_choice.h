// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/simulator/simulated_drive.h>

#include <string>

namespace pcl_nurbs_tools {

/** Which drive is simulated, and with which sensor, in the words of a user. */
struct DriveChoice {
  std::string scene = "town";    /**< town, tunnel, square */
  std::string circuit = "block"; /**< block, oval, eight, line, standstill */
  double size = 120.0;           /**< of the circuit, metres */
  double speed = 8.0;            /**< on the circuit, m/s */
  double laps = 1.2;             /**< of the circuit */
  double sensor_height = 1.89;   /**< of the poses above the road, metres */
  std::string trajectory;        /**< file of poses to drive along instead */
  std::string times;             /**< its times, empty for one pose a turn */
  std::string frame = "camera";  /**< what its poses are of: camera or vehicle */
  std::string calib;             /**< KITTI's calib.txt for a camera */
  std::string sensor = "hdl64";  /**< hdl64, hdl32, vlp16, kinect */
  int columns = 0;               /**< of a laser, 0 for the sensor's own */
  double yaw = -70.0;            /**< of a camera, degrees to the left of ahead */
  double right = 3.0;            /**< of a camera beside the path, metres */
};

/** The drive, in a frame with x ahead and z up.
 * \throws ToolError(kUsage) naming what is wrong \throws pcl::nurbs::InputError */
pcl::nurbs::Trajectory
driveOf(const DriveChoice& choice);

/** What is built around the drive. \throws ToolError(kUsage) */
pcl::nurbs::TownScene
sceneOf(const DriveChoice& choice);

/** The sensor. \throws ToolError(kUsage) */
pcl::nurbs::SimulatedDrive::Sensor
sensorOf(const DriveChoice& choice);

/** Where the sensor sits on the body whose poses are driven. */
Eigen::Isometry3d
mountOf(const DriveChoice& choice);

} // namespace pcl_nurbs_tools
