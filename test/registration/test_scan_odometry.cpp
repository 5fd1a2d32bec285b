// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Odometry over made-up drives with exact truth, and what it does with bad scans.

#include <pcl/registration/scan_odometry.h>
#include <pcl/registration/scan_preprocessing.h>

#include "registration_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** Constant speed through the street with a bend. */
Eigen::Isometry3d
truePose(double time, double turn = 0.02)
{
  Tangent velocity;
  velocity << 0.6, 0.0, 0.0, 0.0, 0.0, turn;
  return exponential(time * velocity);
}

/** Radians per scan; enough to see what skewing does. */
double
turnOf(bool turning)
{
  return turning ? 0.15 : 0.02;
}

/** A sweep around a pose; with \a moving the sensor goes on while it measures. */
ScanPoints
scanAt(double time,
       bool moving,
       bool turning,
       std::mt19937& random,
       std::vector<float>& times)
{
  ScanPoints points;
  times.clear();
  for (const Eigen::Vector3d& world : sampleScene(street(), 40000, 0.01, random)) {
    Eigen::Vector3d seen = truePose(time, turnOf(turning)).inverse() * world;
    float moment = 0.5F;
    // The moment depends on the azimuth at that moment: a few steps settle it.
    for (int i = 0; moving && i < 4; ++i) {
      moment = timesByAzimuth({seen.cast<float>()})[0];
      seen = truePose(time + moment - 0.5, turnOf(turning)).inverse() * world;
    }
    points.emplace_back(seen.cast<float>());
    times.push_back(moment);
  }
  return points;
}

/** Largest error of the position over a drive of a dozen scans. */
double
driveError(bool moving, bool deskewed, int threads, Eigen::Isometry3d& last)
{
  OdometryOptions options;
  options.threads = threads;
  options.min_range = 0.5;
  ScanOdometry odometry(options);
  std::mt19937 random(7);
  double worst = 0.0;
  for (int i = 0; i < 12; ++i) {
    std::vector<float> times;
    const ScanPoints points = scanAt(i, moving && i > 0, moving, random, times);
    const OdometryResult result =
        odometry.process(points, deskewed ? times : std::vector<float>());
    EXPECT_TRUE(result.tracked);
    const Eigen::Isometry3d error =
        (truePose(i, turnOf(moving))).inverse() * result.pose;
    worst = std::max(worst, error.translation().norm());
    last = result.pose;
  }
  return worst;
}

TEST(ScanOdometry, FollowsADrive)
{
  Eigen::Isometry3d one;
  Eigen::Isometry3d two;
  EXPECT_LT(driveError(false, false, 1, one), 0.08);
  driveError(false, false, 3, two);
  EXPECT_EQ(one.matrix(), two.matrix()); // whatever the number of threads
}

TEST(ScanOdometry, DeskewingHelps)
{
  Eigen::Isometry3d last;
  const double with = driveError(true, true, 1, last);
  EXPECT_LT(with, 0.2); // the first motion is not known while it happens
  EXPECT_LT(with, driveError(true, false, 1, last));
}

TEST(ScanOdometry, KeyframesByWayAndByHook)
{
  OdometryOptions options;
  options.keyframe_distance = 2.0;
  options.keyframe_angle = 10.0;
  ScanOdometry odometry(options);
  ScanOdometry hooked(options);
  int asked = 0;
  hooked.setKeyframeDecision([&](const OdometryResult& result, const auto& since) {
    EXPECT_GT(result.match.correspondences, 0U);
    EXPECT_GT(since.translation().norm(), 0.3);
    return ++asked == 3;
  });
  std::vector<int> keyframes;
  std::vector<int> by_hook;
  std::mt19937 random(7);
  for (int i = 0; i < 9; ++i) {
    std::vector<float> times;
    const ScanPoints points = scanAt(i, false, false, random, times);
    if (odometry.process(points).keyframe)
      keyframes.push_back(i);
    if (hooked.process(points).keyframe)
      by_hook.push_back(i);
  }
  EXPECT_EQ(keyframes, (std::vector<int>{0, 4, 8})); // 0.6 m a scan
  EXPECT_EQ(by_hook, (std::vector<int>{0, 3}));
}

TEST(ScanOdometry, BadScansLeaveItOnItsWay)
{
  ScanOdometry odometry;
  std::mt19937 random(7);
  std::vector<float> times;
  EXPECT_FALSE(odometry.process({}).tracked); // before anything
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(odometry.process(scanAt(i, false, false, random, times)).tracked);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(odometry.process({}).tracked);
  const OdometryResult numberless = odometry.process(ScanPoints(100, {nan, nan, nan}));
  EXPECT_FALSE(numberless.tracked);
  EXPECT_FALSE(numberless.keyframe);
  // The prediction goes on, so the next scan is found again.
  EXPECT_LT((numberless.pose.translation() - truePose(5).translation()).norm(), 0.2);
  const OdometryResult back = odometry.process(scanAt(6, false, false, random, times));
  EXPECT_TRUE(back.tracked);
  EXPECT_LT((back.pose.translation() - truePose(6).translation()).norm(), 0.05);
  EXPECT_THROW(odometry.process(ScanPoints(3), {0.0F}), std::invalid_argument);
}

TEST(ScanOdometry, PredictsByTheTimeBetweenScans)
{
  ScanOdometry odometry;
  std::mt19937 random(7);
  std::vector<float> times;
  double last = 0.0;
  const auto drive = [&](double time) {
    const double interval = std::exchange(last, time);
    return odometry.process(
        scanAt(time, false, false, random, times), {}, time - interval);
  };
  for (const double time : {0.0, 1.0, 3.0, 4.0, 6.0, 9.0, 10.0, 12.0}) {
    const OdometryResult result = drive(time);
    EXPECT_TRUE(result.tracked);
    EXPECT_LT((truePose(time).inverse() * result.pose).translation().norm(), 0.1);
  }
  // What the prediction is alone is seen where there is nothing to align.
  const OdometryResult predicted = odometry.process({}, {}, 3.0);
  EXPECT_LT((truePose(15.0).inverse() * predicted.pose).translation().norm(), 0.2);
  EXPECT_THROW(odometry.process({}, {}, -1.0), std::invalid_argument);
  EXPECT_THROW(odometry.process({}, {}, std::nan("")), std::invalid_argument);
  const OdometryResult same = odometry.process({}, {}, 0.0); // a scan seen twice
  EXPECT_TRUE(same.pose.isApprox(predicted.pose));
}

TEST(ScanOdometry, StandsStillAndForgetsWhatIsFar)
{
  OdometryOptions options;
  options.max_range = 15.0;
  ScanOdometry odometry(options);
  std::mt19937 random(7);
  std::vector<float> times;
  const ScanPoints scan = scanAt(0, false, false, random, times);
  for (int i = 0; i < 5; ++i)
    EXPECT_LT(odometry.process(scan).pose.translation().norm(), 5e-3);
  for (const Eigen::Vector3d& point : odometry.localMap())
    EXPECT_LT(point.norm(), options.max_range + 0.1);
}

TEST(ScanOdometry, OptionsThatMakeNoSense)
{
  OdometryOptions options;
  options.max_range = options.min_range;
  EXPECT_THROW(ScanOdometry{options}, std::invalid_argument);
  options = OdometryOptions();
  options.match_spacing = 0.0;
  EXPECT_THROW(ScanOdometry{options}, std::invalid_argument);
  options = OdometryOptions();
  options.threads = 0;
  EXPECT_THROW(ScanOdometry{options}, std::invalid_argument);
}

TEST(MotionThreshold, IsTheDeviationsStandardDeviation)
{
  MotionThresholdOptions options;
  options.initial = 1.0;
  options.min_threshold = 0.1;
  MotionThreshold threshold(options);
  EXPECT_DOUBLE_EQ(threshold.value(), 3.0);
  Eigen::Isometry3d deviation = Eigen::Isometry3d::Identity();
  threshold.addDeviation(deviation); // too small to count
  EXPECT_DOUBLE_EQ(threshold.value(), 3.0);
  deviation.translation().x() = 0.2;
  for (int i = 0; i < 3; ++i)
    threshold.addDeviation(deviation);
  EXPECT_NEAR(threshold.value(), 3.0 * std::sqrt((1.0 + 3 * 0.04) / 4.0), 1e-12);
  for (int i = 0; i < 10000; ++i)
    threshold.addDeviation(deviation);
  EXPECT_NEAR(threshold.value(), 0.6, 0.01);
}

} // namespace
