// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Drives through a small scene: whole, cut short, with bad scans, by the clock.

#include "scene_drive.h"

#include <pcl/mapping/slam_pipeline.h>
#include <pcl/mapping/trajectory_metrics.h>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

constexpr double kStep = 0.06; // of the ellipse's angle, up to 0.09 m
constexpr Ellipse kWay{1.5, 0.8};

SceneDrive
drive(std::size_t scans, int points = 4000)
{
  return SceneDrive(room(), ellipseDrive(scans, kStep, kWay), points);
}

SlamOptions
options(int threads = 2)
{
  SlamOptions result;
  result.odometry.threads = threads;
  result.odometry.min_range = 0.1; // in a room
  result.odometry.map_spacing = 0.1;
  result.odometry.match_spacing = 0.2;
  result.odometry.keyframe_distance = 0.5;
  return result;
}

double
absoluteError(const ScanSource& source, const Trajectory& estimate)
{
  TrajectoryPair pair = associate(*source.truth(), estimate);
  pair.estimate =
      transformed(pair.estimate, alignTrajectory(pair, TrajectoryAlignment::SE3));
  return summarizeErrors(absoluteErrors(pair).translation).rmse;
}

TEST(SlamPipeline, tracksADrive)
{
  const SceneDrive source = drive(30);
  SlamPipeline pipeline(source, options());
  pipeline.run();
  const SlamResult& result = pipeline.result();
  ASSERT_EQ(result.trajectory.size(), 30U);
  EXPECT_EQ(result.tracked, 29U);
  EXPECT_GE(result.keyframes.size(), 2U);
  EXPECT_EQ(result.keyframes.front(), 0U);
  EXPECT_EQ(pipeline.keyframeGraph().graph().nodes().size(), result.keyframes.size());
  EXPECT_EQ(result.skipped, 0U);
  EXPECT_TRUE(result.weak.empty());
  EXPECT_LT(absoluteError(source, result.trajectory), 0.02);
  ASSERT_EQ(result.stages.size(), 4U);
  EXPECT_EQ(result.stages[1].name, "odometry");
  EXPECT_EQ(result.stages[1].times.count(), 30U);
  EXPECT_TRUE(
      result.trajectory[0].T_world_body.isApprox(Eigen::Isometry3d::Identity()));
}

TEST(SlamPipeline, sameBitsForAnyNumberOfThreads)
{
  const SceneDrive source = drive(12);
  std::vector<Trajectory> results;
  for (const int threads : {1, 2, 4}) {
    SlamPipeline pipeline(source, options(threads));
    pipeline.run();
    results.push_back(pipeline.result().trajectory);
  }
  for (const Trajectory& other : results)
    for (std::size_t k = 0; k < other.size(); ++k)
      ASSERT_EQ(other[k].T_world_body.matrix(), results[0][k].T_world_body.matrix());
}

TEST(SlamPipeline, firstCountAndStride)
{
  const SceneDrive source = drive(20);
  SlamOptions asked = options();
  asked.feed.first = 3;
  asked.feed.stride = 2;
  asked.feed.count = 5;
  SlamPipeline pipeline(source, asked);
  std::size_t last_done = 0;
  pipeline.setProgress([&](std::size_t done, std::size_t all) {
    EXPECT_EQ(all, 5U);
    last_done = done;
    return true;
  });
  pipeline.run();
  EXPECT_EQ(pipeline.result().scans, (std::vector<std::size_t>{3, 5, 7, 9, 11}));
  EXPECT_EQ(last_done, 5U);
  asked.feed.count = 100;
  EXPECT_EQ(ScanFeed(source, asked.feed).size(), 9U);
  asked.feed.first = 20;
  EXPECT_THROW(SlamPipeline(source, asked), std::invalid_argument);
  asked.feed = {};
  asked.feed.stride = 0;
  EXPECT_THROW(SlamPipeline(source, asked), std::invalid_argument);
}

TEST(SlamPipeline, endsWhereProgressSaysSo)
{
  const SceneDrive source = drive(1000, 2000);
  SlamPipeline pipeline(source, options());
  pipeline.setProgress([](std::size_t done, std::size_t) { return done < 7; });
  pipeline.run();
  EXPECT_GE(pipeline.result().trajectory.size(), 7U);
  EXPECT_LT(pipeline.result().trajectory.size(), 30U);
}

TEST(SlamPipeline, emptyAndNanScansAreBridgedAndTold)
{
  SceneDrive source = drive(20);
  source.setChange([](std::size_t k, Scan& scan) {
    if (k == 8)
      scan.cloud->clear();
    if (k == 9)
      for (pcl::PointXYZI& point : *scan.cloud)
        point.x = std::numeric_limits<float>::quiet_NaN();
  });
  SlamPipeline pipeline(source, options());
  pipeline.run();
  const SlamResult& result = pipeline.result();
  EXPECT_EQ(result.trajectory.size(), 20U);
  EXPECT_EQ(result.tracked, 17U);
  ASSERT_EQ(result.weak.size(), 1U);
  EXPECT_EQ(result.weak[0].first, 8U);
  EXPECT_EQ(result.weak[0].last, 9U);
  EXPECT_EQ(result.weak[0].weakness, Weakness::Lost);
  EXPECT_LT(absoluteError(source, result.trajectory), 0.1);
}

TEST(SlamPipeline, predictsByTheTimeBetweenScans)
{
  // Scans are left out as on a busy machine, irregularly, by the source or as
  // unreadable.
  const Ellipse circle{1.5, 1.5};
  Trajectory truth = ellipseDrive(40, kStep, circle);
  for (const std::ptrdiff_t dropped : {30, 27, 26, 22, 19, 17, 12, 11, 9})
    truth.erase(truth.begin() + dropped);
  SceneDrive source(room(), truth, 4000);
  const std::size_t blind = 18; // and so a prediction, one step after three
  const std::size_t torn = 16;
  source.setChange([](std::size_t k, Scan& scan) {
    if (k == torn)
      throw InputError("a file", "torn");
    if (k == blind)
      scan.cloud->clear();
  });
  SlamOptions skipping = options();
  skipping.feed.skip_faults = true;
  SlamPipeline pipeline(source, skipping);
  pipeline.run();
  const SlamResult& result = pipeline.result();
  ASSERT_EQ(result.odometry.size(), truth.size() - 1);
  EXPECT_EQ(result.tracked, truth.size() - 3); // the first, the torn and the blind one
  const Eigen::Isometry3d first = truth[0].T_world_body;
  const Eigen::Isometry3d& predicted = result.odometry[blind - 1].T_world_body;
  const Eigen::Isometry3d error =
      (first.inverse() * truth[blind].T_world_body).inverse() * predicted;
  EXPECT_LT(error.translation().norm(), 0.03); // a step is 0.09 m
}

TEST(SlamPipeline, scansSeenTwiceDoNotMove)
{
  Trajectory truth = ellipseDrive(12, kStep, kWay);
  for (std::size_t k = 6; k < truth.size(); ++k)
    truth[k].T_world_body = truth[5].T_world_body; // stands still
  truth[8].stamp = truth[7].stamp;                 // and one is there twice
  const SceneDrive source(room(), truth, 4000);
  SlamPipeline pipeline(source, options());
  pipeline.run();
  const Trajectory& poses = pipeline.result().trajectory;
  ASSERT_EQ(poses.size(), 12U);
  const Eigen::Isometry3d motion =
      poses[7].T_world_body.inverse() * poses[11].T_world_body;
  EXPECT_LT(motion.translation().norm(), 0.02);
}

TEST(SlamPipeline, aDamagedScanEndsTheDriveOrIsLeftOut)
{
  SceneDrive source = drive(20);
  source.setChange([](std::size_t k, Scan&) {
    if (k == 10 || k == 11)
      throw InputError("scan " + std::to_string(k), "is torn");
  });
  SlamPipeline pipeline(source, options());
  try {
    pipeline.run();
    ADD_FAILURE() << "went on";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "scan 10: is torn");
  }
  EXPECT_EQ(pipeline.result().trajectory.size(), 10U);

  SlamOptions skipping = options();
  skipping.feed.skip_faults = true;
  SlamPipeline other(source, skipping);
  other.run();
  const SlamResult& result = other.result();
  EXPECT_EQ(result.trajectory.size(), 18U);
  EXPECT_EQ(result.faults,
            (std::vector<std::string>{"scan 10: is torn", "scan 11: is torn"}));
  ASSERT_EQ(result.weak.size(), 1U);
  EXPECT_EQ(result.weak[0].weakness, Weakness::Unreadable);
  EXPECT_EQ(result.weak[0].last, 11U);
}

TEST(SlamPipeline, byTheClockSlowWorkSkipsScans)
{
  Trajectory truth = ellipseDrive(60, 0.002, kWay);
  for (std::size_t k = 0; k < truth.size(); ++k)
    truth[k].stamp = 0.01 * static_cast<double>(k);
  SceneDrive source(room(), truth, 2000);
  source.setChange([](std::size_t, Scan&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(35)); // of a period of 10
  });
  SlamOptions realtime = options();
  realtime.feed.realtime = true;
  SlamPipeline pipeline(source, realtime);
  pipeline.run();
  const SlamResult& result = pipeline.result();
  EXPECT_GT(result.skipped, 30U);
  EXPECT_GE(result.trajectory.size(), 2U);
  EXPECT_EQ(result.skipped + result.trajectory.size(), 60U);
  EXPECT_GE(result.seconds, 0.55); // no scan before its time
}

TEST(SlamPipeline, byTheClockFastWorkWaits)
{
  const SceneDrive source = drive(5, 2000);
  SlamOptions realtime = options();
  realtime.feed.realtime = true;
  SlamPipeline pipeline(source, realtime);
  pipeline.run();
  EXPECT_GE(pipeline.result().seconds, 0.4);
  EXPECT_LT(pipeline.result().stages[0].times.max(), 0.35) << "waiting is no work";
}

TEST(SlamPipeline, motionWithinScansIsUndone)
{
  // Each point is measured from where the sensor is at its time.
  const Trajectory truth = ellipseDrive(15, kStep, kWay);
  SceneDrive source(room(), truth, 4000);
  source.setChange([&](std::size_t k, Scan& scan) {
    const Eigen::Isometry3d at = truth[k].T_world_body;
    for (std::size_t i = 0; i < scan.cloud->size(); ++i) {
      const double time = 0.1 * (static_cast<double>(i % 100) / 100.0 - 0.5);
      scan.point_times.push_back(static_cast<float>(time));
      const Eigen::Isometry3d then =
          onEllipse(kStep * (static_cast<double>(k) + time / 0.1), kWay);
      auto point = (*scan.cloud)[i].getVector3fMap();
      point = (then.inverse() * at * point.cast<double>()).cast<float>();
    }
  });
  SlamPipeline with(source, options());
  with.run();
  SlamOptions ignored = options();
  ignored.feed.timing = PointTiming::None;
  SlamPipeline without(source, ignored);
  without.run();
  const double error = absoluteError(source, with.result().trajectory);
  EXPECT_LT(error, 0.03);
  EXPECT_LT(error, absoluteError(source, without.result().trajectory));
}

} // namespace
