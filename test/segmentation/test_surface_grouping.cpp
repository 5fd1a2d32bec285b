// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Surface grouping on scenes whose surfaces are known exactly.

#include <pcl/segmentation/surface_grouping.h>

#include "surface_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Labels = std::vector<std::uint32_t>;

TEST(SurfaceGrouping, boxIsItsThreeFaces)
{
  const GroupedScene result = groupScene(boxCorner);
  ASSERT_EQ(result.groups.size(), 3U);
  EXPECT_GT(accuracy(result.truth, result.labels), 0.99);
  for (const SurfaceGroup& face : result.groups) {
    ASSERT_EQ(face.models.size(), 1U);
    EXPECT_EQ(face.models.front().terms, 3) << "a face is plane";
    EXPECT_NEAR(face.rms, 1.0, 0.1);
  }
}

TEST(SurfaceGrouping, foldIsWhereTheModelsIntersect)
{
  const GroupedScene result = groupScene(boxCorner);
  std::size_t wrong = 0;
  for (const std::size_t cell : mismatches(result.truth, result.labels))
    wrong += distanceToOther(kCamera, result.truth, cell) > 4 ? 1 : 0;
  EXPECT_LE(wrong, 4U) << "cells farther than 4 from the fold on the wrong side";
}

TEST(SurfaceGrouping, cylinderAndWallAreOneGroupEach)
{
  const GroupedScene result = groupScene(cylinderBeforeWall);
  ASSERT_EQ(result.groups.size(), 2U) << "the wall's halves are joined";
  EXPECT_GT(accuracy(result.truth, result.labels), 0.98);
}

TEST(SurfaceGrouping, separatedPartsStayApartIfToldTo)
{
  SurfaceGroupingOptions options;
  options.join_separated = false;
  EXPECT_EQ(groupScene(cylinderBeforeWall, options).groups.size(), 3U);
}

TEST(SurfaceGrouping, domeIsOneGroup)
{
  const GroupedScene result = groupScene(domeOnFloor);
  ASSERT_EQ(result.groups.size(), 2U);
  EXPECT_GT(accuracy(result.truth, result.labels), 0.98);
}

TEST(SurfaceGrouping, wallWithWindowsIsOneGroup)
{
  const GroupedScene result = groupScene([](int column, int row) {
    const bool window =
        column % 80 > 25 && column % 80 < 60 && row % 90 > 20 && row % 90 < 70;
    const Hit wall{planeDepth({0.3, 0.0, 1.0}, 2.0, ray(column, row)), 1};
    return window ? Hit{std::nan(""), 0} : wall;
  });
  ASSERT_EQ(result.groups.size(), 1U);
  EXPECT_GT(accuracy(result.truth, result.labels), 0.99);
}

TEST(SurfaceGrouping, wallBehindPillarsIsOneGroup)
{
  const GroupedScene result = groupScene([](int column, int) {
    const bool pillar = column % 107 > 60 && column % 107 < 85;
    return pillar ? Hit{1.2, 2U + static_cast<std::uint32_t>(column / 107)}
                  : Hit{2.0, 1};
  });
  Labels wall;
  for (std::size_t i = 0; i < result.truth.size(); ++i)
    if (result.truth[i] == 1)
      wall.push_back(result.labels[i]);
  EXPECT_GT(std::count(wall.begin(), wall.end(), 1U),
            static_cast<std::ptrdiff_t>(0.97 * static_cast<double>(wall.size())));
}

TEST(SurfaceGrouping, wavyWallIsOneGroup)
{
  const GroupedScene result = groupScene([](int column, int row) {
    const Eigen::Vector3d e = ray(column, row);
    return Hit{1.8 + 0.06 * std::sin(9.0 * e.x()) + 0.04 * std::cos(11.0 * e.y()), 1};
  });
  ASSERT_GE(result.groups.size(), 1U);
  EXPECT_GT(static_cast<double>(result.groups.front().size),
            0.98 * static_cast<double>(result.labels.size()));
  EXPECT_GT(result.groups.front().models.size(), 1U) << "no cubic follows it";
}

TEST(SurfaceGrouping, laserRoomHasItsWallsAndFloor)
{
  const GridGeometry grid = turningLaser(720, 64);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Labels truth;
  const auto cloud = laserCloud(grid, [&](int column, int row) {
    const Eigen::Vector3d e = grid.direction(column, row);
    Hit hit{std::numeric_limits<double>::infinity(), 0};
    std::uint32_t number = 0;
    for (const Eigen::Vector4d& wall : {Eigen::Vector4d(1, 0, 0, 6),
                                        Eigen::Vector4d(-1, 0, 0, 5),
                                        Eigen::Vector4d(0, 1, 0, 7),
                                        Eigen::Vector4d(0, -1, 0, 4),
                                        Eigen::Vector4d(0, 0, -1, 1.2)}) {
      ++number;
      const double along = wall.head<3>().dot(e);
      if (along > 0.0)
        hit = nearer(hit, {wall.w() / along, number});
    }
    truth.push_back(hit.surface);
    return hit.depth + 0.02 * normal(random);
  });
  const GridPoints points = toGridPoints(cloud, grid);
  GridGraph graph;
  graph.build(points, SensorNoise::hdl64());
  graph.setWeights();
  Labels labels;
  EXPECT_EQ(groupSurfaces(points, graph, SensorNoise::hdl64(), {}, labels), 5U);
  EXPECT_GT(accuracy(truth, labels), 0.96);
  EXPECT_EQ(labels[0], labels[719]) << "over the seam";
}

TEST(SurfaceGrouping, labelsAreOrderedAndGroupsDescribeThem)
{
  const GroupedScene result = groupScene(cylinderBeforeWall);
  std::vector<std::size_t> sizes(result.groups.size() + 1, 0);
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    ASSERT_LE(result.labels[i], result.groups.size());
    ++sizes[result.labels[i]];
  }
  for (std::size_t k = 0; k < result.groups.size(); ++k) {
    EXPECT_EQ(result.groups[k].size, sizes[k + 1]);
    if (k > 0) {
      EXPECT_GE(sizes[k], sizes[k + 1]);
    }
  }
}

TEST(SurfaceGrouping, threadsDoNotMatter)
{
  const GroupedScene one = groupScene(domeOnFloor);
  SurfaceGroupingOptions options;
  for (const int threads : {2, 3, 8}) {
    options.threads = threads;
    EXPECT_EQ(groupScene(domeOnFloor, options).labels, one.labels);
  }
}

} // namespace
