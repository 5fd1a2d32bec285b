// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// The depth camera of the simulator against exact depths.

#include <pcl/mapping/simulator/circuits.h>
#include <pcl/mapping/simulator/simulated_drive.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;

Trajectory
startOfDrive(std::size_t poses)
{
  CircuitOptions options;
  options.shape = CircuitShape::Eight;
  options.laps = 0.5;
  Trajectory drive = makeCircuit(options);
  drive.resize(std::min(poses, drive.size()));
  return drive;
}

TEST(SimulatedCamera, seesDepthsInStepsOfDisparity)
{
  SimulationOptions options;
  options.T_body_sensor.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  DepthCameraModel camera = DepthCameraModel::kinect();
  camera.width = 160;
  camera.height = 120;
  camera.intrinsics = {131.25, 131.25, 79.5, 59.5};
  const SimulatedDrive noisy(startOfDrive(5), camera, options);
  options.noise = false;
  const SimulatedDrive exact(startOfDrive(5), camera, options);
  const Scan scan = noisy.read(2);
  const Scan truth = exact.read(2);
  EXPECT_EQ(noisy.calibration().matrix(), Eigen::Matrix4d::Identity());
  int seen = 0;
  for (std::size_t i = 0; i < scan.cloud->size(); ++i) {
    const double depth = (*scan.cloud)[i].z;
    const double true_depth = (*truth.cloud)[i].z;
    if (!std::isfinite(depth))
      continue;
    ++seen;
    const double steps = 131.25 * 0.075 / depth / 0.125;
    ASSERT_NEAR(steps, std::round(steps), 1e-4);
    const double error = 131.25 * 0.075 * (1.0 / depth - 1.0 / true_depth);
    ASSERT_LT(std::abs(error), 6.0 * 0.06 + 0.0626);
  }
  EXPECT_GT(seen, 1000);
}

TEST(SimulatedCamera, theProjectorLeavesShadows)
{
  int shadows = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) { // not every view has an edge
    SimulationOptions options;
    options.town.seed = seed;
    options.T_body_sensor.linear() << -1, 0, 0, 0, 0, -1, 0, -1, 0; // to the right
    DepthCameraModel camera = DepthCameraModel::kinect();
    camera.least_cosine = 0.0;
    const Scan scan = SimulatedDrive(startOfDrive(5), camera, options).read(2);
    options.noise = false;
    const Scan truth = SimulatedDrive(startOfDrive(5), camera, options).read(2);
    for (std::size_t i = 0; i < scan.cloud->size(); ++i)
      shadows +=
          std::isfinite((*truth.cloud)[i].z) && !std::isfinite((*scan.cloud)[i].z);
  }
  EXPECT_GT(shadows, 100);
}

} // namespace
