// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "drive_choice.h"

#include "run_tool.h"
#include "word_choice.h"

#include <pcl/mapping/kitti_calibration.h>
#include <pcl/mapping/simulator/circuits.h>

#include <cmath>
#include <stdexcept>

namespace pcl_nurbs_tools {
namespace {

using namespace pcl::nurbs;

Trajectory
circuitOf(const DriveChoice& choice)
{
  CircuitOptions options;
  options.shape = chosen<CircuitShape>("the circuit",
                                       choice.circuit,
                                       {{"block", CircuitShape::Block},
                                        {"oval", CircuitShape::Oval},
                                        {"eight", CircuitShape::Eight},
                                        {"line", CircuitShape::Line},
                                        {"standstill", CircuitShape::Standstill}});
  options.size = choice.size;
  options.speed = choice.speed;
  options.laps = choice.laps;
  options.height = choice.sensor_height;
  if (choice.sensor == "kinect")
    options.period = DepthCameraModel::kinect().period;
  try {
    return makeCircuit(options);
  } catch (const std::invalid_argument&) {
    throw ToolError(kUsage,
                    "the circuit must be at least 60 m, its speed, laps and the height "
                    "of the sensor positive, with at most a million poses");
  }
}

/** Poses by their number get the times of a sensor that never stops. */
void
spreadTimes(Trajectory& drive, double period)
{
  for (std::size_t k = 0; k < drive.size(); ++k)
    if (drive[k].stamp != static_cast<double>(k))
      return;
  for (StampedPose& pose : drive)
    pose.stamp *= period;
}

} // namespace

Trajectory
driveOf(const DriveChoice& choice)
{
  if (choice.frame != "camera" && choice.frame != "vehicle")
    throw ToolError(kUsage, "the frame of poses must be camera or vehicle");
  if (choice.trajectory.empty()) {
    if (!choice.times.empty() || !choice.calib.empty())
      throw ToolError(kUsage, "times and calib of a drive go with its trajectory");
    return circuitOf(choice);
  }
  Trajectory drive = readTrajectory(choice.trajectory, choice.times);
  if (choice.times.empty())
    spreadTimes(drive, 0.1);
  if (choice.frame == "camera") {
    const Eigen::Isometry3d T_camera_laser = choice.calib.empty()
                                                 ? nominalKittiCalibration()
                                                 : readKittiCalibration(choice.calib);
    drive = inLaserFrame(drive, T_camera_laser);
  }
  return drive;
}

TownScene
sceneOf(const DriveChoice& choice)
{
  return chosen<TownScene>("the scene",
                           choice.scene,
                           {{"town", TownScene::Streets},
                            {"tunnel", TownScene::Tunnel},
                            {"square", TownScene::Square}});
}

SimulatedDrive::Sensor
sensorOf(const DriveChoice& choice)
{
  if (choice.sensor == "kinect")
    return DepthCameraModel::kinect();
  const auto model = chosen<LaserModel (*)()>("the sensor",
                                              choice.sensor,
                                              {{"hdl64", LaserModel::hdl64},
                                               {"hdl32", LaserModel::hdl32},
                                               {"vlp16", LaserModel::vlp16},
                                               {"kinect", nullptr}});
  if (choice.columns < 0 || choice.columns > 65536)
    throw ToolError(kUsage, "the columns of a laser must be 0 to 65536");
  LaserModel laser = model();
  if (choice.columns > 0)
    laser.columns = choice.columns;
  return laser;
}

Eigen::Isometry3d
mountOf(const DriveChoice& choice)
{
  if (choice.sensor != "kinect")
    return Eigen::Isometry3d::Identity();
  if (!std::isfinite(choice.yaw) || !std::isfinite(choice.right))
    throw ToolError(kUsage, "the place of a camera must be finite");
  Eigen::Matrix3d axes;
  axes << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  Eigen::Isometry3d mount = Eigen::Isometry3d::Identity();
  mount.linear() =
      Eigen::AngleAxisd(choice.yaw * M_PI / 180.0, Eigen::Vector3d::UnitZ()).matrix() *
      axes;
  mount.translation().y() = -choice.right;
  return mount;
}

} // namespace pcl_nurbs_tools
