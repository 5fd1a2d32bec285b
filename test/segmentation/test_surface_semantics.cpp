// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// What counts as one surface: arches, gaps, thin things, steep faces, sparse samples.

#include <pcl/segmentation/surface_grouping.h>

#include "surface_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** Labels of a laser's cloud under the noise of an HDL-64; \a range is a function
 * (direction) -> range. \a jitter is the error of azimuths in columns. */
template <typename Range>
LabelImage
groupLaser(const GridGeometry& grid, const Range& range, double jitter = 0.0)
{
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto cloud = laserCloud(grid, [&](int column, int row) {
    const double where = column + jitter * normal(random);
    return range(grid.direction(where, row)) + 0.02 * normal(random);
  });
  const GridPoints points = toGridPoints(cloud, grid);
  GridGraph graph;
  graph.build(points, SensorNoise::hdl64());
  graph.setWeights();
  LabelImage labels;
  groupSurfaces(points, graph, SensorNoise::hdl64(), {}, labels);
  return labels;
}

/** Half a ring, seen from the front, before a wall. */
Hit
archBeforeWall(int column, int row)
{
  const Eigen::Vector3d e = ray(column, row);
  Hit hit{2.0, 1};
  const double major = 0.45;
  const double minor = 0.09;
  const Eigen::Vector3d middle(0.0, 0.25, 1.6);
  // The first meeting along the ray, by steps of the signed distance.
  const Eigen::Vector3d direction = e.normalized();
  double along = 1.2;
  for (int step = 0; step < 60; ++step) {
    const Eigen::Vector3d p = along * direction - middle;
    const double ring = std::hypot(p.x(), p.y()) - major;
    const double distance = std::hypot(ring, p.z()) - minor;
    if (distance < 1e-6)
      return p.y() <= 0.0 ? nearer(hit, {along * direction.z(), 2}) : hit;
    along += distance;
  }
  return hit;
}

TEST(SurfaceSemantics, archIsOneGroup)
{
  const GroupedScene result = groupScene(archBeforeWall);
  ASSERT_EQ(result.groups.size(), 2U);
  EXPECT_GT(accuracy(result.truth, result.labels), 0.97);
}

/** Two boards in one plane; what is seen between them is at \a between. */
Hit
boards(int column, double between)
{
  const bool gap = column > 130 && column < 190;
  return gap ? Hit{between, 2} : Hit{1.5, 1};
}

std::pair<std::uint32_t, std::uint32_t>
labelsOfBoards(double between)
{
  const GroupedScene result =
      groupScene([between](int column, int) { return boards(column, between); });
  const std::size_t row = 120 * 320;
  return {result.labels[row + 60], result.labels[row + 260]};
}

TEST(SurfaceSemantics, partsBehindAnOccluderAreOneSurface)
{
  const auto [left, right] = labelsOfBoards(1.0);
  EXPECT_NE(left, 0U);
  EXPECT_EQ(left, right);
}

TEST(SurfaceSemantics, partsWithNothingBetweenAreOneSurface)
{
  const auto [left, right] = labelsOfBoards(std::nan(""));
  EXPECT_NE(left, 0U);
  EXPECT_EQ(left, right);
}

TEST(SurfaceSemantics, partsThatRaysPassBetweenAreTwoSurfaces)
{
  const auto [left, right] = labelsOfBoards(2.5);
  EXPECT_NE(left, 0U);
  EXPECT_NE(right, 0U);
  EXPECT_NE(left, right);
}

TEST(SurfaceSemantics, wallWithWindowsToAFarRoomIsOneGroup)
{
  const GroupedScene result = groupScene([](int column, int row) {
    const bool window =
        column % 80 > 25 && column % 80 < 60 && row % 90 > 20 && row % 90 < 70;
    const Eigen::Vector3d e = ray(column, row);
    return window ? Hit{planeDepth({0.0, 0.0, 1.0}, 4.0, e), 2}
                  : Hit{planeDepth({0.3, 0.0, 1.0}, 2.0, e), 1};
  });
  std::size_t wall = 0;
  std::size_t whole = 0;
  for (std::size_t i = 0; i < result.truth.size(); ++i)
    if (result.truth[i] == 1) {
      ++wall;
      whole += result.labels[i] == 1 ? 1 : 0;
    }
  EXPECT_GT(static_cast<double>(whole), 0.97 * static_cast<double>(wall));
}

TEST(SurfaceSemantics, floorAroundThingsIsOneGroup)
{
  const GroupedScene result = groupScene([](int column, int row) {
    const Eigen::Vector3d e = ray(column, row);
    const Hit floor{planeDepth({0.0, std::sqrt(0.5), std::sqrt(0.5)}, 1.4, e), 1};
    const bool thing = column % 70 > 40 && row % 60 > 25;
    return thing ? Hit{0.8 * floor.depth,
                       2U + static_cast<std::uint32_t>(column / 70 + 5 * (row / 60))}
                 : floor;
  });
  std::size_t floor = 0;
  std::size_t whole = 0;
  for (std::size_t i = 0; i < result.truth.size(); ++i)
    if (result.truth[i] == 1) {
      ++floor;
      whole += result.labels[i] == 1 ? 1 : 0;
    }
  EXPECT_GT(static_cast<double>(whole), 0.97 * static_cast<double>(floor));
}

TEST(SurfaceSemantics, railOfAFewRingsIsASurface)
{
  const GridGeometry grid = turningLaser(720, 64);
  const auto is_rail = [&](int column, int row) {
    return column > 100 && column < 400 && row >= 24 && row < 28;
  };
  const LabelImage labels = groupLaser(grid, [&](const Eigen::Vector3d& e) {
    const Eigen::Vector3d chart = grid.chart(e);
    const Eigen::Vector2d cell = grid.cell(chart.x(), chart.y());
    const bool rail = is_rail(static_cast<int>(std::lround(cell.x())),
                              static_cast<int>(std::lround(cell.y())));
    return (rail ? 6.0 : 25.0) / e.head<2>().norm();
  });
  std::size_t found = 0;
  std::size_t cells = 0;
  const std::uint32_t label = labels[25 * 720 + 250];
  ASSERT_NE(label, 0U);
  for (int row = 24; row < 28; ++row)
    for (int column = 105; column < 395; ++column) {
      ++cells;
      found += labels[static_cast<std::size_t>(row * 720 + column)] == label ? 1 : 0;
    }
  EXPECT_GT(static_cast<double>(found), 0.95 * static_cast<double>(cells));
  EXPECT_NE(label, labels[10 * 720 + 250]);
}

TEST(SurfaceSemantics, steepWallUnderErrorsOfTheAzimuthIsOneGroup)
{
  // A corridor: its walls are steep ahead, where a fifth of a column is decimetres.
  const GridGeometry grid = turningLaser(720, 64);
  LabelImage truth;
  const auto wall = [](const Eigen::Vector3d& e) {
    const double side = 3.0 / std::abs(e.y());
    const double end = 20.0 / std::abs(e.x());
    return std::min(side, end);
  };
  for (int row = 0; row < grid.height; ++row)
    for (int column = 0; column < grid.width; ++column) {
      const Eigen::Vector3d e = grid.direction(column, row);
      const bool side = 3.0 / std::abs(e.y()) < 20.0 / std::abs(e.x());
      truth.push_back(side ? (e.y() > 0.0 ? 1 : 2) : (e.x() > 0.0 ? 3 : 4));
    }
  const LabelImage labels = groupLaser(grid, wall, 0.2);
  EXPECT_GT(accuracy(truth, labels), 0.95);
  EXPECT_LE(*std::max_element(labels.begin(), labels.end()), 8U);
}

TEST(SurfaceSemantics, sparseRoofHasTwoSides)
{
  GridGeometry grid;
  grid.projection = GridProjection::plane;
  grid.width = 200;
  grid.height = 200;
  grid.frame = GridGeometry::mapFrame();
  grid.step_u = grid.step_v = 0.1;
  grid.max_gap = 5;
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const SensorNoise noise{0.03, 0.0, 0.0};
  GridPoints points;
  points.geometry = grid;
  LabelImage truth;
  for (int row = 0; row < grid.height; ++row)
    for (int column = 0; column < grid.width; ++column) {
      const bool there = uniform(random) < 0.15;
      const double x = 0.1 * column;
      const Eigen::Vector3d chart(x, 0.1 * row, -0.5 * std::abs(x - 10.0));
      const Eigen::Vector3d p =
          grid.frame.transpose() *
          (chart + Eigen::Vector3d(0.0, 0.0, noise.constant * normal(random)));
      const double nan = std::nan("");
      points.x.push_back(static_cast<float>(there ? p.x() : nan));
      points.y.push_back(static_cast<float>(there ? p.y() : nan));
      points.z.push_back(static_cast<float>(there ? p.z() : nan));
      truth.push_back(there ? (x < 10.0 ? 1 : 2) : 0);
    }
  completeGridPoints(points);
  GridGraph graph;
  graph.build(points, noise);
  graph.setWeights();
  LabelImage labels;
  EXPECT_EQ(groupSurfaces(points, graph, noise, {}, labels), 2U);
  EXPECT_GT(accuracy(truth, labels), 0.97);
}

} // namespace
