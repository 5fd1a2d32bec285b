// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Odometry where the surroundings hold little, where the sensor turns fast, and where a
// scan does not belong.

#include <pcl/registration/scan_odometry.h>

#include "registration_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

constexpr double kNoise = 0.01;
constexpr double kSpeed = 0.5; // metres per scan, along x

Eigen::Isometry3d
at(double x, double y = 0.0)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << x, y, 0.0;
  return pose;
}

/** What a sensor sees within a range, every scan with noise of its own. */
ScanPoints
scanFrom(const Scene& scene,
         const Eigen::Isometry3d& pose,
         double range,
         std::mt19937& random,
         int samples = 12000)
{
  ScanPoints points;
  for (const Eigen::Vector3d& world : sampleScene(scene, samples, kNoise, random)) {
    const Eigen::Vector3d seen = pose.inverse() * world;
    if (seen.norm() < range)
      points.emplace_back(seen.cast<float>());
  }
  return points;
}

OdometryOptions
nearOptions()
{
  OdometryOptions options;
  options.min_range = 0.3;
  return options;
}

/** The direction that a scan had no hold in, translation first. */
Eigen::Vector3d
unsupportedWay(const OdometryResult& result)
{
  return result.match.degeneracy.directions.col(0).head<3>();
}

TEST(HardDrives, AStandingSensorDoesNotDrift)
{
  std::mt19937 random(1);
  ScanOdometry odometry(nearOptions());
  for (int i = 0; i < 30; ++i) {
    const auto result = odometry.process(scanFrom(street(), at(0), 30.0, random));
    EXPECT_TRUE(result.tracked);
    EXPECT_LT(result.pose.translation().norm(), 0.01) << "scan " << i;
  }
}

TEST(HardDrives, ATunnelKeepsTheSpeedAndSaysWhatItDoesNotHold)
{
  Scene scene = corridor();
  // The end wall tells the speed while it is in sight.
  scene.push_back({{-20, -1.5, -1.5}, {0, 3, 0}, {0, 0, 3}});
  std::mt19937 random(2);
  ScanOdometry odometry(nearOptions());
  const double start = -18.0;
  int unsupported = 0;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Isometry3d truth = at(kSpeed * i);
    const auto result =
        odometry.process(scanFrom(scene, at(start) * truth, 6.0, random));
    EXPECT_TRUE(result.tracked) << "scan " << i;
    const Eigen::Vector3d error = (truth.inverse() * result.pose).translation();
    EXPECT_LT(error.tail<2>().norm(), 0.1) << "scan " << i;
    EXPECT_LT(std::abs(error.x()), 0.1 * kSpeed * i + 0.05) << "scan " << i;
    if (i == 0 || result.match.degeneracy.unsupported == 0)
      continue;
    ++unsupported;
    EXPECT_EQ(result.match.degeneracy.unsupported, 1);
    EXPECT_GT(std::abs(unsupportedWay(result).x()), 0.99);
    EXPECT_GE(result.match.covariance(0, 0), 0.9 * kUnsupportedVariance);
    EXPECT_LT(result.match.covariance(1, 1), 1e-4 * kUnsupportedVariance);
  }
  EXPECT_GT(unsupported, 10);
}

TEST(HardDrives, AnEmptySquareHoldsHeightAndTilt)
{
  std::mt19937 random(3);
  ScanOdometry odometry(nearOptions());
  for (int i = 0; i < 20; ++i) {
    const auto result = odometry.process(scanFrom(ground(20), at(0), 15.0, random));
    EXPECT_TRUE(result.tracked);
    EXPECT_LT(result.pose.translation().norm(), 0.01) << "scan " << i;
    EXPECT_LT(Eigen::AngleAxisd(result.pose.linear()).angle(), 0.002) << "scan " << i;
    if (i == 0)
      continue;
    EXPECT_EQ(result.match.degeneracy.unsupported, 3);
    EXPECT_LT(result.match.covariance(2, 2), 1e-5 * kUnsupportedVariance);
  }
}

TEST(HardDrives, AWallOnFlatGroundHoldsNothingAlongIt)
{
  Scene scene = ground(40);
  scene.push_back({{-40, 4, -1.7}, {80, 0, 0}, {0, 0, 6}});
  for (const int samples : {20000, 40000}) {
    std::mt19937 random(2);
    ScanOdometry odometry(nearOptions());
    int reported = 0;
    for (int i = 0; i < 12; ++i) {
      const Eigen::Isometry3d truth = at(kSpeed * i);
      const auto result =
          odometry.process(scanFrom(scene, at(-10) * truth, 20.0, random, samples));
      EXPECT_TRUE(result.tracked) << "scan " << i;
      const Eigen::Vector3d place = result.pose.translation();
      EXPECT_LT(std::abs(place.x()), 0.05) << "scan " << i; // no speed was ever seen
      EXPECT_LT(place.tail<2>().norm(), 0.02) << "scan " << i;
      if (i == 0 || result.match.degeneracy.unsupported == 0)
        continue;
      ++reported;
      EXPECT_GT(std::abs(unsupportedWay(result).x()), 0.99) << "scan " << i;
    }
    EXPECT_GE(reported, 10) << samples << " samples";
  }
}

/** Balls filled with leaves beside the way. */
std::vector<Eigen::Vector3d>
bushes(std::mt19937& random)
{
  std::uniform_real_distribution<double> place(-25.0, 25.0);
  std::uniform_real_distribution<double> size(0.6, 1.6);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Eigen::Vector3d> leaves;
  for (int i = 0; i < 40; ++i) {
    const double radius = size(random);
    const double x = place(random);
    const double y = place(random);
    const Eigen::Vector3d middle(x, std::abs(y) < 2.0 ? y + 4.0 : y, radius - 1.7);
    for (int k = 0; k < 600; ++k) {
      const double a = unit(random);
      const double b = unit(random);
      const Eigen::Vector3d leaf(a, b, unit(random));
      if (leaf.norm() < 1.0)
        leaves.emplace_back(middle + radius * leaf);
    }
  }
  return leaves;
}

TEST(HardDrives, BushesHold)
{
  std::mt19937 random(1);
  const std::vector<Eigen::Vector3d> leaves = bushes(random);
  std::bernoulli_distribution seen(0.5);
  ScanOdometry odometry(nearOptions());
  int reported = 0;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry3d truth = at(kSpeed * i);
    const Eigen::Isometry3d pose = at(-8) * truth;
    ScanPoints scan = scanFrom(ground(25), pose, 20.0, random, 8000);
    for (const Eigen::Vector3d& leaf : leaves) {
      const Eigen::Vector3d place = pose.inverse() * leaf;
      if (place.norm() < 20.0 && seen(random))
        scan.emplace_back(place.cast<float>());
    }
    const auto result = odometry.process(scan);
    EXPECT_LT((result.pose.translation() - truth.translation()).norm(), 0.25)
        << "scan " << i;
    reported += i > 0 && result.match.degeneracy.unsupported > 0 ? 1 : 0;
  }
  EXPECT_LE(reported, 3); // while the map is young
}

TEST(HardDrives, FastTurnsAreSearchedFor)
{
  std::mt19937 random(5);
  ScanOdometry odometry(nearOptions());
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
  int searched = 0;
  for (int i = 0; i < 10; ++i) {
    const auto result = odometry.process(scanFrom(street(), truth, 30.0, random));
    EXPECT_TRUE(result.tracked) << "scan " << i;
    EXPECT_LT((truth.inverse() * result.pose).translation().norm(), 0.05)
        << "scan " << i;
    searched += result.searched ? 1 : 0;
    Tangent turn;
    turn << 0.4, 0.2, 0.0, 0.1, -0.1, i % 2 == 0 ? 1.2 : -0.9;
    truth = truth * exponential(turn);
  }
  EXPECT_GT(searched, 4);
}

TEST(HardDrives, AJumpIsSearchedFor)
{
  std::mt19937 random(8);
  ScanOdometry odometry(nearOptions());
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(
        odometry.process(scanFrom(street(), at(kSpeed * i), 30.0, random)).tracked);
  Tangent jump;
  jump << 7.0, -1.5, 0.0, 0.05, 0.0, 0.9;
  const Eigen::Isometry3d truth = at(kSpeed * 3) * exponential(jump);
  const auto found = odometry.process(scanFrom(street(), truth, 30.0, random));
  EXPECT_TRUE(found.tracked);
  EXPECT_TRUE(found.searched);
  EXPECT_LT((found.pose.translation() - truth.translation()).norm(), 0.05);
}

TEST(HardDrives, SparseScansOnTheirWayAreNotSearchedFor)
{
  std::mt19937 random(7);
  ScanOdometry odometry(nearOptions());
  double smallest = 1.0;
  for (int i = 0; i < 10; ++i) {
    const auto result =
        odometry.process(scanFrom(street(), at(kSpeed * i), 30.0, random, 11000));
    EXPECT_TRUE(result.tracked) << "scan " << i;
    EXPECT_LT((result.pose.translation() - at(kSpeed * i).translation()).norm(), 0.1);
    if (i < 2) // before a speed is known it may be
      continue;
    EXPECT_FALSE(result.searched) << "scan " << i;
    smallest = std::min(smallest, result.match.inlier_share);
  }
  EXPECT_LT(smallest, 0.7); // the map is too sparse for more
}

TEST(HardDrives, AScanFromElsewhereIsNotTracked)
{
  std::mt19937 random(6);
  ScanOdometry odometry(nearOptions());
  for (int i = 0; i < 6; ++i)
    EXPECT_TRUE(
        odometry.process(scanFrom(street(), at(kSpeed * i), 30.0, random)).tracked);
  std::uniform_real_distribution<float> place(-20.0F, 20.0F);
  ScanPoints fog;
  for (int i = 0; i < 4000; ++i)
    fog.emplace_back(place(random), place(random), 0.2F * place(random));
  const OdometryResult lost = odometry.process(fog);
  EXPECT_FALSE(lost.tracked);
  EXPECT_LT((lost.pose.translation() - at(kSpeed * 6).translation()).norm(), 0.05);
  const auto found = odometry.process(scanFrom(street(), at(kSpeed * 7), 30.0, random));
  EXPECT_TRUE(found.tracked); // the fog did not get into the map
  EXPECT_LT((found.pose.translation() - at(kSpeed * 7).translation()).norm(), 0.05);
}

} // namespace
