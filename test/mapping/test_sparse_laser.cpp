// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// A laser with few beams that begins on a curved road, in full motion, or anew.

#include "scene_rays.h"
#include "town_drives.h"

#include <pcl/mapping/pipeline/scan_feed.h>
#include <pcl/registration/scan_odometry.h>
#include <pcl/registration/scan_preprocessing.h>

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

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

/** How far off a laser is at the end of 27 m, which it begins in full motion. */
double
wayError(int beams, const OdometryOptions& options)
{
  const auto at = [](int scan) {
    return Eigen::Isometry3d(Eigen::Translation3d(-15.0 + 0.75 * scan, 0.0, 0.0));
  };
  constexpr int kLast = 36;
  std::mt19937 random(1);
  ScanOdometry odometry(options);
  Eigen::Isometry3d last;
  for (int i = 0; i <= kLast; ++i)
    last = odometry.process(ringScan(street(), at(i), beams, 600, 0.01, random)).pose;
  return (at(0) * last).translation().x() - at(kLast).translation().x();
}

TEST(SparseLaser, ringsDoNotHoldItBack)
{
  OdometryOptions options;
  EXPECT_LT(std::abs(wayError(16, options)), 0.1);
  EXPECT_LT(std::abs(wayError(32, options)), 0.1);
  options.first_way = 0.0; // its rings say that it stands
  EXPECT_LT(wayError(16, options), -10.0);
}

/** What fits nowhere. */
ScanPoints
fog(std::mt19937& random)
{
  std::uniform_real_distribution<float> place(-20.0F, 20.0F);
  ScanPoints points;
  for (int i = 0; i < 4000; ++i)
    points.emplace_back(place(random), place(random), 0.2F * place(random));
  return points;
}

/** As turnError(), but since the first scan that is tracked after some scans of fog, by
 * which the map is lost. */
double
turnErrorAfterFog(const SimulatedDrive& drive, const OdometryOptions& options)
{
  constexpr std::size_t kFog = 8;
  constexpr std::size_t kClear = 14;
  std::mt19937 random(2);
  ScanOdometry odometry(options);
  ScanFeed feed(drive, {});
  std::optional<std::size_t> begin;
  Eigen::Isometry3d first = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d last = first;
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const ReadScan scan = feed.next();
    const bool foggy = i >= kFog && i < kClear;
    const auto result = foggy ? odometry.process(fog(random))
                              : odometry.process(scan.points, scan.times, 0.1);
    EXPECT_EQ(result.tracked, i < kFog || i > kClear);
    last = result.pose;
    if (begin || i < kClear || !result.tracked)
      continue;
    begin = i;
    first = result.pose;
  }
  const Trajectory& truth = *drive.truth();
  const Eigen::Isometry3d moved =
      truth.at(begin.value()).T_world_body.inverse() * truth.back().T_world_body;
  return Eigen::AngleAxisd((moved.inverse() * first.inverse() * last).linear()).angle();
}

TEST(SparseLaser, isKnownWhenTheMapIsBegunAnewInMotion)
{
  LaserModel laser = LaserModel::vlp16();
  laser.columns = 900;
  SimulationOptions simulation;
  simulation.motion_distortion = true; // rings that are deskewed are none
  const SimulatedDrive drive(shortDrive(50), laser, simulation);
  OdometryOptions options;
  options.reference_time = 0.0; // stamps are in the middle, times count from them
  EXPECT_LT(turnErrorAfterFog(drive, options), 0.02);
  options.first_way = 0.0;
  EXPECT_GT(turnErrorAfterFog(drive, options), 0.025);
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
  options.first_voxels = 0.0;
  EXPECT_THROW(ScanOdometry{options}, std::invalid_argument);
  options = {};
  options.first_way = -1.0;
  EXPECT_THROW(ScanOdometry{options}, std::invalid_argument);
}

} // namespace
