// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Preprocessing against closed forms.

#include <pcl/registration/scan_preprocessing.h>

#include "registration_scenes.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <tuple>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

ScanPoints
roomPoints(int count)
{
  std::mt19937 random(1);
  ScanPoints points;
  for (const Eigen::Vector3d& point : sampleScene(room(), count, 0.0, random))
    points.emplace_back(point.cast<float>());
  return points;
}

TEST(VoxelSubsample, OneRealPointPerVoxel)
{
  const ScanPoints points = roomPoints(5000);
  const ScanPoints kept = voxelSubsample(points, 0.4);
  std::set<std::tuple<int, int, int>> all;
  std::set<std::tuple<int, int, int>> cells;
  const auto cell = [](const Eigen::Vector3f& p) {
    const Eigen::Array3d index = (p.cast<double>() / 0.4).array().floor();
    return std::make_tuple(int(index.x()), int(index.y()), int(index.z()));
  };
  for (const Eigen::Vector3f& point : points)
    all.insert(cell(point));
  for (const Eigen::Vector3f& point : kept) {
    EXPECT_TRUE(cells.insert(cell(point)).second);
    EXPECT_NE(std::find(points.begin(), points.end(), point), points.end());
  }
  EXPECT_EQ(cells, all);
}

TEST(VoxelSubsample, BadInput)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(voxelSubsample({}, 1.0).empty());
  EXPECT_TRUE(voxelSubsample({{nan, 0, 0}, {0, 0, 1e30F}}, 1.0).empty());
  EXPECT_THROW(voxelSubsample({}, 0.0), std::invalid_argument);
}

TEST(SuitableVoxelSize, FollowsTheScaleOfTheCloud)
{
  const ScanPoints points = roomPoints(8000);
  const double size = suitableVoxelSize(points);
  EXPECT_GT(size, 0.05);
  EXPECT_LT(size, 0.8);
  ScanPoints large = points;
  for (Eigen::Vector3f& point : large)
    point *= 64.0F;
  EXPECT_NEAR(suitableVoxelSize(large), 64.0 * size, 1e-3);
  EXPECT_EQ(suitableVoxelSize({}), 1.0);
  EXPECT_EQ(suitableVoxelSize(ScanPoints(50, {1, 1, 1})), 1.0);
}

TEST(VerticalAngle, RaisesAllPointsAtTheirRange)
{
  const ScanPoints before = roomPoints(500);
  ScanPoints after = before;
  correctVerticalAngle(after, 0.01);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(after[i].norm(), before[i].norm(), 1e-5F);
    EXPECT_NEAR(std::atan2(after[i].y(), after[i].x()),
                std::atan2(before[i].y(), before[i].x()),
                1e-5F);
    EXPECT_NEAR(std::asin(after[i].z() / after[i].norm()) -
                    std::asin(before[i].z() / before[i].norm()),
                0.01F,
                1e-4F);
  }
  ScanPoints above{{0.0F, 0.0F, 2.0F}};
  correctVerticalAngle(above, 0.01);
  EXPECT_EQ(above[0], Eigen::Vector3f(0.0F, 0.0F, 2.0F));
}

TEST(Deskew, UndoesAConstantVelocity)
{
  std::mt19937 random(3);
  const Eigen::Isometry3d motion = randomMotion(2.0, 0.3, random);
  const Tangent velocity = logarithm(motion);
  const ScanPoints still = roomPoints(1000); // seen from where the scan begins
  std::vector<float> times;
  ScanPoints skewed;
  for (std::size_t i = 0; i < still.size(); ++i) {
    times.push_back(static_cast<float>(i) / static_cast<float>(still.size() - 1));
    const Eigen::Isometry3d pose =
        exponential(static_cast<double>(times[i]) * velocity);
    skewed.emplace_back((pose.inverse() * still[i].cast<double>()).cast<float>());
  }
  for (const double reference : {0.0, 0.5, 1.0}) {
    const Eigen::Isometry3d seen_from = exponential(reference * velocity);
    ScanPoints points = skewed;
    deskew(points, times, motion, reference, 2);
    for (std::size_t i = 0; i < still.size(); ++i)
      EXPECT_LT((seen_from * points[i].cast<double>() - still[i].cast<double>()).norm(),
                1e-4);
  }
  EXPECT_THROW(deskew(skewed, {0.0F}, motion, 0.5), std::invalid_argument);
}

TEST(TimesByAzimuth, BeginBehindAndPassTheFrontHalfway)
{
  const std::vector<float> times = timesByAzimuth(
      {{-1, 1e-4F, 0}, {0, 1, 0}, {1, 0, 0}, {0, -1, 0}, {-1, -1e-4F, 0}});
  const std::vector<float> expected{0.0F, 0.25F, 0.5F, 0.75F, 1.0F};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(times[i], expected[i], 1e-4F);
}

} // namespace
