// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// VoxelMap against brute force over all points.

#include <pcl/registration/voxel_map.h>

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <thread>

namespace {

using namespace pcl::nurbs;

std::vector<Eigen::Vector3d>
randomPoints(std::size_t count,
             double half,
             const Eigen::Vector3d& center,
             unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-half, half);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = uniform(random);
    const double y = uniform(random);
    points.emplace_back(center + Eigen::Vector3d(x, y, uniform(random)));
  }
  return points;
}

VoxelMap
mapOf(const std::vector<Eigen::Vector3d>& points, const VoxelMapOptions& options)
{
  VoxelMap map(options);
  for (const Eigen::Vector3d& point : points)
    map.insert(point);
  return map;
}

VoxelMapOptions
keepAll()
{
  VoxelMapOptions options;
  options.max_points = 100;
  options.min_spacing = 0.0;
  return options;
}

TEST(VoxelMap, NearestIsThatOfAllPointsAtAnyDistance)
{
  for (const double where : {0.0, 20000.0}) { // 20 km away floats have steps of 2 mm
    const Eigen::Vector3d center(where, -where, 0.5 * where);
    const auto points = randomPoints(2000, 5.0, center, 1);
    const VoxelMap map = mapOf(points, keepAll());
    for (const Eigen::Vector3d& place : randomPoints(300, 9.0, center, 2))
      for (const double reach : {0.1, 0.4, 1.0, 3.0, 20.0}) {
        double best = reach;
        for (const Eigen::Vector3d& point : points)
          best = std::min(best, (point - place).norm());
        const auto found = map.nearest(place, reach);
        ASSERT_EQ(found.has_value(), best < reach);
        if (found) {
          EXPECT_NEAR((*found - place).norm(), best, 1e-5);
        }
      }
  }
}

TEST(VoxelMap, SurfaceIsTheMomentsOfItsBlock)
{
  const auto points = randomPoints(3000, 3.0, {100.0, -50.0, 3.0}, 3);
  VoxelMapOptions options;
  options.max_points = 2; // what is not kept counts all the same
  const VoxelMap map = mapOf(points, options);
  for (const Eigen::Vector3d& place : randomPoints(50, 2.5, {100.0, -50.0, 3.0}, 4)) {
    const double size = options.voxel_size;
    const Eigen::Array3d low = ((place / size).array() - 0.5).floor() * size;
    std::vector<Eigen::Vector3d> inside;
    for (const Eigen::Vector3d& point : points)
      if ((point.array() >= low).all() && (point.array() < low + 2 * size).all())
        inside.push_back(point);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : inside)
      mean += point / static_cast<double>(inside.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& point : inside)
      covariance += (point - mean) * (point - mean).transpose() /
                    static_cast<double>(inside.size());
    const PointMoments found = map.surface(place);
    EXPECT_EQ(found.count, static_cast<double>(inside.size()));
    EXPECT_LT((found.mean - mean).norm(), 1e-9);
    EXPECT_LT((found.covariance - covariance).norm(), 1e-9);
  }
}

TEST(VoxelMap, KeepsFewPointsApart)
{
  VoxelMapOptions options;
  options.max_points = 5;
  options.min_spacing = 0.15;
  const VoxelMap map = mapOf(randomPoints(20000, 1.0, {0, 0, 0}, 5), options);
  EXPECT_EQ(map.voxelCount(), 64U);
  EXPECT_LE(map.points().size(), 5 * map.voxelCount());
  EXPECT_GE(map.points().size(), 4 * map.voxelCount());
}

TEST(VoxelMap, ForgetsWhatIsFar)
{
  const auto points = randomPoints(5000, 20.0, {0, 0, 0}, 6);
  VoxelMap map = mapOf(points, keepAll());
  const Eigen::Vector3d center(5.0, 0.0, 0.0);
  map.removeFarFrom(center, 10.0);
  const double slack = map.options().voxel_size; // voxels go as a whole
  for (const Eigen::Vector3d& point : points) {
    const double distance = (point - center).norm();
    const auto found = map.nearest(point, 0.01);
    if (distance < 10.0 - slack) {
      EXPECT_TRUE(found && (*found - point).norm() < 1e-5);
    }
    if (distance > 10.0 + slack) {
      EXPECT_FALSE(found);
    }
  }
  EXPECT_TRUE(map.insert(points[0]));
  EXPECT_TRUE(map.nearest(points[0], 0.01));
  map.clear();
  EXPECT_TRUE(map.empty());
  EXPECT_FALSE(map.nearest(center, 100.0));
  EXPECT_EQ(map.surface(center).count, 0.0);
}

TEST(VoxelMap, PlacesThatCannotBe)
{
  VoxelMap map;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity, 1e30}) {
    EXPECT_FALSE(map.insert({bad, 0.0, 0.0}));
    EXPECT_FALSE(map.nearest({0.0, bad, 0.0}, 1.0));
    EXPECT_EQ(map.surface({0.0, 0.0, bad}).count, 0.0);
  }
  EXPECT_TRUE(map.empty());
  map.insert({1.0, 2.0, 3.0});
  EXPECT_FALSE(map.nearest({1.0, 2.0, 3.0}, nan));
  EXPECT_FALSE(map.nearest({1.0, 2.0, 3.0}, -1.0));
}

TEST(VoxelMap, OptionsThatMakeNoSense)
{
  for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    VoxelMapOptions options;
    options.voxel_size = size;
    EXPECT_THROW(VoxelMap{options}, std::invalid_argument);
  }
  VoxelMapOptions options;
  options.max_points = 0;
  EXPECT_THROW(VoxelMap{options}, std::invalid_argument);
}

TEST(VoxelMap, ManyReaders)
{
  const auto points = randomPoints(5000, 5.0, {0, 0, 0}, 7);
  const VoxelMap map = mapOf(points, keepAll());
  std::vector<int> found(4, 0);
  std::vector<std::thread> readers;
  for (std::size_t i = 0; i < found.size(); ++i)
    readers.emplace_back([&, i] {
      for (const Eigen::Vector3d& point : points)
        found[i] += map.nearest(point, 0.01) ? 1 : 0;
    });
  for (std::thread& reader : readers)
    reader.join();
  for (const int count : found)
    EXPECT_EQ(count, 5000);
}

} // namespace
