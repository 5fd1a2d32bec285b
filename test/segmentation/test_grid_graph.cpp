// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// The lattice graph against a brute-force one, over the seam of a grid that wraps and
// over gaps; noise models against noise that was put in.

#include <pcl/segmentation/grid_graph.h>

#include "grid_clouds.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** Random holes in a laser's view of random ranges. */
GridPoints
randomLaser(int width, int height, int max_gap, unsigned seed)
{
  std::mt19937 random(seed);
  GridGeometry grid = turningLaser(width, height);
  grid.max_gap = max_gap;
  const auto cloud = laserCloud(grid, [&](int, int) {
    return random() % 4 == 0 ? std::nan("")
                             : 1.0 + 1e-3 * static_cast<double>(random() % 1000);
  });
  return toGridPoints(cloud, grid);
}

/** Neighbour by the definition: first point at most max_gap cells away. */
std::int32_t
expectedTarget(const GridPoints& points, int row, int column, int down, int right)
{
  const GridGeometry& grid = points.geometry;
  for (int gap = 1; gap <= grid.max_gap; ++gap) {
    const int r = row + gap * down;
    const int c = (column + gap * right + 10 * grid.width) % grid.width;
    if (r >= grid.height)
      return GridGraph::kNone;
    if (points.valid(static_cast<std::size_t>(r * grid.width + c)))
      return r * grid.width + c;
  }
  return GridGraph::kNone;
}

class GraphLaws : public testing::TestWithParam<int> {};

TEST_P(GraphLaws, edgesAreTheNeighbours)
{
  const GridPoints points = randomLaser(30, 12, GetParam(), 11);
  GridGraph graph;
  graph.build(points, SensorNoise::hdl64());
  graph.setWeights();
  const int steps[4][2] = {{0, 1}, {1, 0}, {1, 1}, {1, -1}};
  std::size_t edges = 0;
  for (int d = 0; d < 4; ++d)
    for (int row = 0; row < 12; ++row)
      for (int column = 0; column < 30; ++column) {
        const auto cell = static_cast<std::size_t>(row * 30 + column);
        const std::int32_t target =
            points.valid(cell)
                ? expectedTarget(points, row, column, steps[d][0], steps[d][1])
                : GridGraph::kNone;
        ASSERT_EQ(graph.target(d)[cell], target);
        if (target == GridGraph::kNone) {
          EXPECT_EQ(graph.weight(d)[cell], 0.0F);
          continue;
        }
        ++edges;
        const auto far = static_cast<std::size_t>(target);
        EXPECT_EQ(graph.source(d)[far], static_cast<std::int32_t>(cell));
        const float distance = (points.point(cell) - points.point(far)).squaredNorm();
        EXPECT_FLOAT_EQ(graph.squaredDistance(d)[cell], distance);
        EXPECT_NEAR(graph.weight(d)[cell],
                    std::exp(-0.5 * distance / graph.variance(d)[cell]),
                    1e-6);
      }
  EXPECT_EQ(graph.numEdges(), edges);
}

INSTANTIATE_TEST_SUITE_P(Gaps, GraphLaws, testing::Values(1, 2, 5));

TEST(GridGraph, fourNeighboursAreASubset)
{
  const GridPoints points = randomLaser(20, 10, 1, 3);
  GridGraph eight;
  eight.build(points, {});
  GridGraph four;
  four.build(points, {}, {4, 20.0F});
  ASSERT_EQ(four.numDirections(), 2);
  for (int d = 0; d < 2; ++d)
    EXPECT_EQ(four.target(d), eight.target(d));
}

TEST(GridGraph, weightOfAFacingNeighbourIsThatOfOneSpacing)
{
  const GridGeometry grid = GridGeometry::pinhole(32, 24, {40.0, 40.0, 15.5, 11.5});
  for (const double depth : {1.0, 5.0, 50.0}) {
    const GridPoints points =
        toGridPoints(cameraCloud(grid, [=](int, int) { return depth; }), grid);
    GridGraph graph;
    graph.build(points, {});
    graph.setWeights();
    // The same at any depth: the spacing grows as the distance does.
    EXPECT_NEAR(graph.weight(GridGraph::kRight)[100], std::exp(-0.5), 1e-4);
    EXPECT_NEAR(graph.weight(GridGraph::kDownLeft)[100], std::exp(-0.5), 1e-4);
  }
}

TEST(GridGraph, customWeightsSeeTheirCells)
{
  const GridPoints points = randomLaser(20, 10, 1, 8);
  GridGraph graph;
  graph.build(points, {});
  graph.setWeights([](std::size_t i, std::size_t j, float, float) {
    return static_cast<float>(i * 1000 + j);
  });
  for (int d = 0; d < graph.numDirections(); ++d)
    for (std::size_t i = 0; i < graph.numCells(); ++i)
      if (graph.target(d)[i] != GridGraph::kNone) {
        EXPECT_EQ(graph.weight(d)[i],
                  static_cast<float>(i * 1000 +
                                     static_cast<std::size_t>(graph.target(d)[i])));
      }
}

TEST(GridGraph, refusesWhatMakesNoSense)
{
  GridPoints points = randomLaser(20, 10, 1, 8);
  GridGraph graph;
  EXPECT_THROW(graph.build(points, {}, {6, 20.0F}), std::invalid_argument);
  EXPECT_THROW(graph.build(points, {}, {8, 0.5F}), std::invalid_argument);
  points.geometry.max_gap = 0;
  EXPECT_THROW(graph.build(points, {}), std::invalid_argument);
  points.geometry.width = 3;
  EXPECT_THROW(completeGridPoints(points), std::invalid_argument);
}

TEST(SensorNoise, modelsGiveTheirPublishedValues)
{
  EXPECT_NEAR(SensorNoise::kinect().sigma(0.4), 0.0012, 1e-12);
  EXPECT_NEAR(SensorNoise::kinect().sigma(2.4), 0.0012 + 0.0019 * 4.0, 1e-12);
  EXPECT_EQ(SensorNoise::hdl64().sigma(3.0), SensorNoise::hdl64().sigma(70.0));
}

TEST(SensorNoise, estimateFindsWhatWasAdded)
{
  const GridGeometry grid =
      GridGeometry::pinhole(320, 240, {260.0, 260.0, 159.5, 119.5});
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const SensorNoise truth{0.002, 0.001, 0.0};
  const auto cloud = cameraCloud(grid, [&](int, int row) {
    const double depth = 1.0 / (1.0 - 0.003 * row); // a floor from 1 m to 3.5 m
    return depth + truth.sigma(depth) * normal(random);
  });
  const SensorNoise found = SensorNoise::estimate(toGridPoints(cloud, grid));
  for (const double depth : {1.2, 2.0, 3.0})
    EXPECT_NEAR(found.sigma(depth) / truth.sigma(depth), 1.0, 0.12);
}

TEST(SensorNoise, estimateOfExactDepthIsTiny)
{
  const GridGeometry grid = GridGeometry::pinhole(160, 120, {130.0, 130.0, 79.5, 59.5});
  const auto cloud = cameraCloud(grid, [](int column, int row) {
    return 1.0 / (1.0 - 0.002 * row - 0.001 * column);
  });
  EXPECT_LT(SensorNoise::estimate(toGridPoints(cloud, grid)).sigma(1.5), 1e-5);
}

} // namespace
