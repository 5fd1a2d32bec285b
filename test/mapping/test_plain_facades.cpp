// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// A depth camera that passes plain facades.

#include <pcl/mapping/simulator/circuits.h>
#include <pcl/mapping/simulator/simulated_drive.h>
#include <pcl/registration/scan_odometry.h>
#include <pcl/registration/scan_preprocessing.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace pcl::nurbs;

/** Along the houses at a walking pace, six images a second; the camera looks at them,
 * 20 degrees ahead. */
SimulatedDrive
alongHouses(std::size_t images)
{
  const DepthCameraModel camera = DepthCameraModel::kinect();
  CircuitOptions line;
  line.shape = CircuitShape::Line;
  line.size = 60.0;
  line.speed = 1.0;
  line.period = 5.0 * camera.period;
  Trajectory drive = makeCircuit(line);
  drive.resize(images);
  SimulationOptions options;
  const double turn = -70.0 * M_PI / 180.0;
  options.T_body_sensor.translation() << 0.0, -3.0, 0.0;
  options.T_body_sensor.linear() << std::sin(turn), 0.0, std::cos(turn),
      -std::cos(turn), 0.0, std::sin(turn), 0.0, -1.0, 0.0;
  return SimulatedDrive(drive, camera, options);
}

TEST(PlainFacades, areReportedToHoldNothingAlongThem)
{
  constexpr std::size_t kYoung = 7; // a map of fewer images has few planes
  constexpr std::size_t kImages = 42;
  const SimulatedDrive drive = alongHouses(kImages);
  ScanOdometry odometry(OdometryOptions::rgbd());
  int reported = 0;
  for (std::size_t i = 0; i < kImages; ++i) {
    const auto result = odometry.process(finitePoints(*drive.read(i).cloud));
    EXPECT_TRUE(result.tracked);
    reported += i >= kYoung && result.match.degeneracy.unsupported > 0 ? 1 : 0;
  }
  EXPECT_GE(reported, 32); // of 35
}

} // namespace
