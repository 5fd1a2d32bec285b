// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "common_options.h"

#include <pcl/mapping/simulator/circuits.h>
#include <pcl/mapping/simulator/drive_writer.h>

#include <string>

namespace pcl_nurbs_tools {

/** What simulate_scans is asked for. */
struct SimulationSettings {
  CommonOptions common;
  std::string out;
  std::string sensor;
  std::string circuit;
  std::string trajectory;
  std::string times;
  std::string calib;
  std::string frame;
  double size = 0.0;
  double speed = 0.0;
  double yaw = 0.0;   /**< of a camera, degrees to the left */
  double right = 0.0; /**< of a camera beside the path, metres */
  int columns = 0;    /**< of a laser, 0 for the sensor's own */
  bool exact = false;
  pcl::nurbs::SimulationOptions simulation;
  pcl::nurbs::DriveWriteOptions writing;
};

/** \return false when help or version was asked for and printed
 * \throws ToolError(kUsage) */
bool
parseSettings(int argc, char** argv, SimulationSettings& settings);

/** The drive that was asked for, in a frame with x ahead and z up. */
pcl::nurbs::Trajectory
driveOf(const SimulationSettings& settings);

/** The sensor that was asked for. */
pcl::nurbs::SimulatedDrive::Sensor
sensorOf(const SimulationSettings& settings);

} // namespace pcl_nurbs_tools
