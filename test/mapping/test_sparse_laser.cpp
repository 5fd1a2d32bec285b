// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// A laser with few beams that begins on a curved road.

#include "town_drives.h"

#include <pcl/registration/scan_odometry.h>
#include <pcl/registration/scan_preprocessing.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** By how much the last pose of a drive is turned against the first one's, radians. */
double
turnError(const SimulatedDrive& drive, const OdometryOptions& options)
{
  ScanOdometry odometry(options);
  Eigen::Isometry3d last;
  for (std::size_t k = 0; k < drive.size(); ++k)
    last = odometry.process(finitePoints(*drive.read(k).cloud)).pose;
  const Trajectory& truth = *drive.truth();
  const Eigen::Isometry3d moved =
      truth.front().T_world_body.inverse() * truth.back().T_world_body;
  return Eigen::AngleAxisd((moved.inverse() * last).linear()).angle();
}

TEST(SparseLaser, seesTheRoadBendFromTheStart)
{
  LaserModel laser = LaserModel::vlp16();
  laser.columns = 900;
  const SimulatedDrive drive(shortDrive(30), laser, {});
  OdometryOptions options;
  EXPECT_LT(turnError(drive, options), 0.03);
  options.first_way = 0.0; // such a drive needs the first map
  EXPECT_GT(turnError(drive, options), 0.04);
}

TEST(SparseLaser, isKnownByItsScan)
{
  const auto sparse = [](const LaserModel& laser) {
    const SimulatedDrive drive(shortDrive(1), laser, {});
    const ScanPoints points = finitePoints(*drive.read(0).cloud);
    return isSparse(voxelSubsample(points, OdometryOptions().map_spacing));
  };
  EXPECT_TRUE(sparse(LaserModel::vlp16()));
  EXPECT_TRUE(sparse(LaserModel::hdl32()));
  EXPECT_FALSE(sparse(LaserModel::hdl64()));
  EXPECT_FALSE(isSparse({}));
}

TEST(SparseLaser, refusesAFirstMapThatMakesNoSense)
{
  OdometryOptions options;
  options.first_voxels = 0.5;
  EXPECT_THROW(ScanOdometry{options}, std::invalid_argument);
  options = {};
  options.first_way = -1.0;
  EXPECT_THROW(ScanOdometry{options}, std::invalid_argument);
}

} // namespace
