// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Coarser maps against maps made from the points, and rough guesses that only they
// bring home.

#include <pcl/registration/map_pyramid.h>
#include <pcl/registration/scan_preprocessing.h>

#include "scene_rays.h"

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

VoxelMap
mapOf(const ScanPoints& points, double voxel_size)
{
  VoxelMapOptions options;
  options.voxel_size = voxel_size;
  options.min_spacing = 0.1 * voxel_size;
  VoxelMap map(options);
  for (const Eigen::Vector3f& point : points)
    map.insert(point.cast<double>());
  return map;
}

TEST(CoarsenedMap, HasTheMomentsOfAllPoints)
{
  std::mt19937 random(1);
  const ScanPoints points =
      ringScan(street(), Eigen::Isometry3d::Identity(), 16, 500, 0.02, random);
  const VoxelMap coarse = mapOf(points, 0.5).coarsened();
  const VoxelMap expected = mapOf(points, 1.0);
  EXPECT_EQ(coarse.voxelCount(), expected.voxelCount());
  EXPECT_EQ(coarse.options().voxel_size, 1.0);
  for (std::size_t i = 0; i < points.size(); i += 7) {
    const PointMoments ours = coarse.surface(points[i].cast<double>());
    const PointMoments theirs = expected.surface(points[i].cast<double>());
    EXPECT_EQ(ours.count, theirs.count);
    EXPECT_LT((ours.mean - theirs.mean).norm(), 1e-9);
    EXPECT_LT((ours.covariance - theirs.covariance).norm(), 1e-9);
  }
}

TEST(CoarsenedMap, KeepsPointsOfTheFineOne)
{
  std::mt19937 random(2);
  const VoxelMap fine = mapOf(
      ringScan(room(), Eigen::Isometry3d::Identity(), 16, 500, 0.01, random), 0.2);
  const VoxelMap coarse = fine.coarsened();
  EXPECT_LT(coarse.points().size(), fine.points().size());
  for (const Eigen::Vector3d& point : coarse.points()) {
    const auto nearest = fine.nearest(point, 0.1);
    ASSERT_TRUE(nearest);
    EXPECT_LT((*nearest - point).norm(), 1e-6);
  }
  EXPECT_TRUE(VoxelMap().coarsened().empty());
}

TEST(MapPyramid, BringsRoughGuessesHomeThatTheFineMapDoesNot)
{
  std::mt19937 random(3);
  const Eigen::Isometry3d truth = randomMotion(0.5, 0.05, random);
  const VoxelMap fine = mapOf(
      ringScan(street(), Eigen::Isometry3d::Identity(), 24, 300, 0.02, random), 0.5);
  const ScanPoints scan = ringScan(street(), truth, 24, 300, 0.02, random);
  const MapPyramid pyramid(fine);
  int with = 0;
  int without = 0;
  for (int i = 0; i < 10; ++i) {
    const Eigen::Isometry3d guess = truth * randomMotion(2.0, 0.2, random);
    const auto home = [&](const MatchResult& result) {
      return (truth.inverse() * result.pose).translation().norm() < 0.05 ? 1 : 0;
    };
    with += home(pyramid.match(scan, {}, guess, {}));
    without += home(matchScan(fine, scan, {}, guess, {}));
  }
  EXPECT_GE(with, 9);
  EXPECT_LE(without, 6);
}

TEST(MapPyramid, KeepsToTheLargestDistanceAsked)
{
  std::mt19937 random(4);
  const ScanPoints points =
      ringScan(street(), Eigen::Isometry3d::Identity(), 32, 700, 0.0, random);
  const MapPyramid pyramid(mapOf(points, 0.5));
  Eigen::Isometry3d guess = Eigen::Isometry3d::Identity();
  guess.translation() << 1.5, 0.0, 0.0;
  MatchOptions options;
  options.max_distance = 0.2; // smaller than any coarser voxel
  const MatchResult near = pyramid.match(points, {}, guess, options);
  EXPECT_EQ(near.pose.matrix(),
            matchScan(pyramid.fine(), points, {}, guess, options).pose.matrix());
}

TEST(MapPyramid, RefusesWhatMakesNoSense)
{
  EXPECT_THROW(MapPyramid(VoxelMap(), -1), std::invalid_argument);
  EXPECT_FALSE(MapPyramid(VoxelMap())
                   .match({}, {}, Eigen::Isometry3d::Identity(), {})
                   .converged);
}

TEST(SuitableVoxelSize, IsThatOfThingsAndNotOfTheLandscape)
{
  std::mt19937 random(5);
  for (const int beams : {16, 64}) {
    const double size = suitableVoxelSize(
        ringScan(street(), Eigen::Isometry3d::Identity(), beams, 900, 0.02, random));
    EXPECT_GT(size, 0.2) << beams;
    EXPECT_LT(size, 2.0) << beams;
  }
}

} // namespace
