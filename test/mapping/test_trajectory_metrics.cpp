// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Trajectory metrics against evo's own figures, closed forms and invariances.

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/trajectory_metrics.h>

#include "test_data.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace pcl::nurbs;

constexpr double kDegrees = 180.0 / M_PI;

TrajectoryPair
kitti00(const std::filesystem::path& folder)
{
  return {readTrajectory((folder / "KITTI_00_gt.txt").string()),
          readTrajectory((folder / "KITTI_00_ORB.txt").string())};
}

TEST(TrajectoryMetrics, absoluteErrorsAreEvos)
{
  PCL_NURBS_DATA_OR_SKIP(folder, "evo");
  TrajectoryPair pair = kitti00(folder);
  pair.estimate =
      transformed(pair.estimate, alignTrajectory(pair, TrajectoryAlignment::SE3));
  const ErrorStatistics ape = summarizeErrors(absoluteErrors(pair).translation);
  EXPECT_EQ(ape.count, 4541U);
  EXPECT_NEAR(ape.rmse, 1.3034497145650266, 1e-6);
  EXPECT_NEAR(ape.mean, 1.1569971285389768, 1e-6);
  EXPECT_NEAR(ape.median, 1.065624769555848, 1e-6);
  EXPECT_NEAR(ape.std, 0.6002822693968323, 1e-6);
  EXPECT_NEAR(ape.min, 0.06931322021483087, 1e-6);
  EXPECT_NEAR(ape.max, 3.587949120678954, 1e-6);
  EXPECT_NEAR(ape.sse, 7715.073440292808, 1e-2);
}

TEST(TrajectoryMetrics, relativeErrorsAreEvos)
{
  PCL_NURBS_DATA_OR_SKIP(folder, "evo");
  const ErrorStatistics rpe = summarizeErrors(
      relativeErrors(kitti00(folder), 10.0, RelativeUnit::Metres).translation);
  EXPECT_NEAR(rpe.rmse, 0.22626134329310163, 1e-5);
  EXPECT_NEAR(rpe.mean, 0.16901737200653275, 1e-5);
  EXPECT_NEAR(rpe.median, 0.13848432516645606, 1e-5);
  EXPECT_NEAR(rpe.max, 1.2722090778658726, 1e-5);
}

TEST(TrajectoryMetrics, kittiErrorsAreTheBenchmarks)
{
  PCL_NURBS_DATA_OR_SKIP(folder, "evo");
  const auto segments = kittiSegments(kitti00(folder));
  EXPECT_EQ(segments.size(), 3283U);
  const KittiErrors mean = meanErrors(segments);
  EXPECT_NEAR(100.0 * mean.translation, 0.699729, 1e-6);
  EXPECT_NEAR(100.0 * kDegrees * mean.rotation, 0.253330, 1e-6);
}

Trajectory
randomWalk(std::size_t poses, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Trajectory result(poses);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t k = 0; k < poses; ++k) {
    result[k] = {0.1 * static_cast<double>(k), pose};
    const Eigen::Vector3d axis(normal(random), normal(random), normal(random));
    pose.rotate(Eigen::AngleAxisd(0.1 * axis.norm(), axis.normalized()));
    pose.translate(Eigen::Vector3d(1.0, 0.1 * normal(random), 0.1 * normal(random)));
  }
  return result;
}

TEST(TrajectoryMetrics, alignmentUndoesASimilarity)
{
  const Trajectory truth = randomWalk(50, 1);
  SimilarityTransform similarity;
  similarity.rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  similarity.translation = {4.0, -5.0, 6.0};
  for (const double scale : {1.0, 0.25}) {
    similarity.scale = scale;
    TrajectoryPair pair{truth, transformed(truth, similarity)};
    const auto alignment =
        scale == 1.0 ? TrajectoryAlignment::SE3 : TrajectoryAlignment::Sim3;
    const SimilarityTransform found = alignTrajectory(pair, alignment);
    EXPECT_NEAR(found.scale * scale, 1.0, 1e-12);
    pair.estimate = transformed(pair.estimate, found);
    const PoseErrors errors = absoluteErrors(pair);
    EXPECT_LT(summarizeErrors(errors.translation).max, 1e-11);
    EXPECT_LT(summarizeErrors(errors.rotation).max, 1e-7);
  }
}

TEST(TrajectoryMetrics, positionsOnALineAreNotAligned)
{
  Trajectory line(10);
  for (std::size_t k = 0; k < line.size(); ++k)
    line[k].T_world_body.translation().x() = static_cast<double>(k);
  EXPECT_THROW(alignTrajectory({line, line}, TrajectoryAlignment::SE3),
               std::invalid_argument);
  const Trajectory two = randomWalk(2, 3);
  EXPECT_THROW(alignTrajectory({two, two}, TrajectoryAlignment::SE3),
               std::invalid_argument);
  EXPECT_EQ(alignTrajectory({line, line}, TrajectoryAlignment::None).scale, 1.0);
}

TEST(TrajectoryMetrics, relativeErrorsForgetTheWorldFrame)
{
  const Trajectory truth = randomWalk(100, 5);
  SimilarityTransform moved;
  moved.rotation = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  moved.translation = {1.0, 2.0, 3.0};
  for (const RelativeUnit unit :
       {RelativeUnit::Poses, RelativeUnit::Metres, RelativeUnit::Seconds}) {
    const PoseErrors errors =
        relativeErrors({truth, transformed(truth, moved)}, 3.0, unit);
    ASSERT_GE(errors.translation.size(), 2U);
    EXPECT_LT(summarizeErrors(errors.translation).max, 1e-12);
  }
  EXPECT_THROW(relativeErrors({truth, truth}, 0.0, RelativeUnit::Poses),
               std::invalid_argument);
}

/** A constant turn of the estimate is that angle per step. */
TEST(TrajectoryMetrics, knownDriftIsFound)
{
  Trajectory straight(101);
  Trajectory drifting(101);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t k = 0; k <= 100; ++k) {
    straight[k].T_world_body.translation().x() = static_cast<double>(k);
    drifting[k].T_world_body = pose;
    pose.translate(Eigen::Vector3d(1.01, 0.0, 0.0));
    pose.rotate(Eigen::AngleAxisd(0.001, Eigen::Vector3d::UnitZ()));
  }
  const PoseErrors errors =
      relativeErrors({straight, drifting}, 1.0, RelativeUnit::Poses);
  ASSERT_EQ(errors.rotation.size(), 100U);
  for (double angle : errors.rotation)
    EXPECT_NEAR(angle, 0.001, 1e-12);
  for (double length : errors.translation)
    EXPECT_NEAR(length, 0.01, 1e-12);
}

TEST(TrajectoryMetrics, segmentsEndBehindTheirLength)
{
  Trajectory straight(311);
  for (std::size_t k = 0; k < straight.size(); ++k)
    straight[k].T_world_body.translation().x() = static_cast<double>(k);
  const auto segments = kittiSegments({straight, straight});
  ASSERT_FALSE(segments.empty());
  EXPECT_EQ(segments[0].last, 101U);
  EXPECT_EQ(segments.size(), 21U + 11U + 1U);
  EXPECT_EQ(meanErrors(segments, 200.0).segments, 11U);
  EXPECT_EQ(meanErrors(segments).translation, 0.0);
  straight.resize(50);
  EXPECT_TRUE(kittiSegments({straight, straight}).empty());
}

TEST(TrajectoryMetrics, posesArePairedByTheNearestTime)
{
  const Trajectory truth = randomWalk(100, 7); // every 0.1 s
  Trajectory estimate;
  for (std::size_t k = 3; k < 90; k += 9) {
    estimate.push_back(truth[k]);
    estimate.back().stamp += k % 2 == 0 ? 0.004 : -0.004;
  }
  estimate.back().stamp += 0.03; // too far
  const TrajectoryPair pair = associate(truth, estimate, 0.01);
  ASSERT_EQ(pair.reference.size(), estimate.size() - 1);
  EXPECT_EQ(summarizeErrors(absoluteErrors(pair).translation).max, 0.0);
  const TrajectoryPair swapped = associate(estimate, truth, 0.01);
  EXPECT_EQ(swapped.reference.size(), pair.reference.size());
  EXPECT_TRUE(associate(truth, {}, 0.01).reference.empty());
}

TEST(TrajectoryMetrics, statisticsOfAList)
{
  const ErrorStatistics s = summarizeErrors({4.0, 1.0, 3.0, 2.0});
  EXPECT_EQ(s.count, 4U);
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(s.min, 1.0);
  EXPECT_DOUBLE_EQ(s.max, 4.0);
  EXPECT_EQ(summarizeErrors({}).count, 0U);
}

} // namespace
