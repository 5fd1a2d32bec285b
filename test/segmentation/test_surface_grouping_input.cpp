// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Surface grouping of clouds that are hardly any, and with options that make no sense.

#include <pcl/segmentation/surface_grouping.h>

#include "grid_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Labels = std::vector<std::uint32_t>;
using Depth = std::function<double(int, int)>;

GridGeometry
cameraOf(int width, int height)
{
  return GridGeometry::pinhole(
      width, height, {525.0, 525.0, 0.5 * (width - 1.0), 0.5 * (height - 1.0)});
}

Labels
labelsOf(const GridPoints& points,
         const SurfaceGroupingOptions& options = {},
         const SensorNoise& noise = SensorNoise::kinect())
{
  GridGraph graph;
  graph.build(points, noise);
  graph.setWeights();
  Labels labels;
  std::vector<SurfaceGroup> groups;
  const std::uint32_t count =
      groupSurfaces(points, graph, noise, options, labels, &groups);
  EXPECT_EQ(labels.size(), points.size());
  EXPECT_EQ(groups.size(), count);
  for (const std::uint32_t label : labels)
    EXPECT_LE(label, count);
  for (const SurfaceGroup& group : groups)
    EXPECT_TRUE(std::isfinite(group.rms));
  return labels;
}

Labels
labelsOf(int width, int height, const Depth& depth)
{
  const GridGeometry grid = cameraOf(width, height);
  return labelsOf(toGridPoints(cameraCloud(grid, depth), grid));
}

std::size_t
labelled(const Labels& labels)
{
  return labels.size() -
         static_cast<std::size_t>(std::count(labels.begin(), labels.end(), 0U));
}

TEST(SurfaceGroupingInput, noPointsGiveNoGroups)
{
  EXPECT_EQ(labelled(labelsOf(GridPoints())), 0U);
  EXPECT_EQ(labelled(labelsOf(64, 48, [](int, int) { return std::nan(""); })), 0U);
}

TEST(SurfaceGroupingInput, singlePointsGiveNoGroups)
{
  const Depth lonely = [](int column, int row) {
    return column % 5 == 2 && row % 5 == 2 ? 1.0 : std::nan("");
  };
  EXPECT_EQ(labelled(labelsOf(64, 48, lonely)), 0U);
  EXPECT_EQ(labelled(labelsOf(2, 1, [](int, int) { return 1.0; })), 0U);
  EXPECT_EQ(labelled(labelsOf(1, 1, [](int, int) { return 1.0; })), 0U);
}

TEST(SurfaceGroupingInput, rowsAndColumnsAreNoSurfaces)
{
  EXPECT_EQ(labelled(labelsOf(640, 1, [](int, int) { return 1.0; })), 0U);
  EXPECT_EQ(labelled(labelsOf(1, 480, [](int, int) { return 1.0; })), 0U);
}

TEST(SurfaceGroupingInput, constantDepthIsOneGroup)
{
  const Labels labels = labelsOf(128, 96, [](int, int) { return 1.5; });
  EXPECT_EQ(std::count(labels.begin(), labels.end(), 1U), 128 * 96);
}

TEST(SurfaceGroupingInput, emptyCellsStayWithoutLabel)
{
  std::mt19937 random(5);
  const Depth holes = [&](int, int) { return random() % 4 == 0 ? std::nan("") : 1.5; };
  const GridGeometry grid = cameraOf(128, 96);
  const GridPoints points = toGridPoints(cameraCloud(grid, holes), grid);
  const Labels labels = labelsOf(points);
  for (std::size_t cell = 0; cell < labels.size(); ++cell)
    ASSERT_EQ(labels[cell], points.valid(cell) ? 1U : 0U);
}

TEST(SurfaceGroupingInput, exactPointsWithoutNoiseAreGrouped)
{
  const GridGeometry grid = cameraOf(160, 120);
  const auto cloud = cameraCloud(grid, [](int column, int) {
    return column < 80 ? 1.0 + 0.004 * column : 1.32 - 0.004 * (column - 80);
  });
  const Labels labels = labelsOf(toGridPoints(cloud, grid), {}, SensorNoise{});
  EXPECT_EQ(*std::max_element(labels.begin(), labels.end()), 2U);
  EXPECT_EQ(labelled(labels), labels.size());
}

TEST(SurfaceGroupingInput, wildCoordinatesDoNoHarm)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> exponent(-30.0, 30.0);
  labelsOf(64, 48, [&](int, int) { return std::pow(10.0, exponent(random)); });
  labelsOf(64, 48, [](int, int) { return 1e30; });
  labelsOf(64, 48, [](int, int) { return 1e-30; });
}

TEST(SurfaceGroupingInput, heightFieldAndLatticeAreGrouped)
{
  for (const GridProjection projection :
       {GridProjection::plane, GridProjection::lattice}) {
    GridPoints points;
    points.geometry.projection = projection;
    points.geometry.width = 60;
    points.geometry.height = 50;
    points.geometry.step_u = points.geometry.step_v = 0.1;
    for (int row = 0; row < 50; ++row)
      for (int column = 0; column < 60; ++column) {
        points.x.push_back(0.1F * static_cast<float>(column));
        points.y.push_back(0.1F * static_cast<float>(row));
        points.z.push_back(column < 30 ? 0.0F : 2.0F);
      }
    completeGridPoints(points);
    const Labels labels = labelsOf(points, {}, {0.01, 0.0, 0.0});
    EXPECT_NE(labels.front(), labels[59]);
    EXPECT_EQ(*std::max_element(labels.begin(), labels.end()), 2U);
    EXPECT_EQ(labelled(labels), labels.size());
  }
}

TEST(SurfaceGroupingInput, extremeWeightsDoNoHarm)
{
  const GridGeometry grid = cameraOf(64, 48);
  const GridPoints points =
      toGridPoints(cameraCloud(grid, [](int, int) { return 1.0; }), grid);
  GridGraph graph;
  graph.build(points, SensorNoise::kinect());
  Labels labels;
  graph.setWeights([](std::size_t, std::size_t, float, float) { return 0.0F; });
  groupSurfaces(points, graph, SensorNoise::kinect(), {}, labels);
  graph.setWeights([](std::size_t, std::size_t, float, float) {
    return std::numeric_limits<float>::infinity();
  });
  EXPECT_EQ(groupSurfaces(points, graph, SensorNoise::kinect(), {}, labels), 1U);
}

TEST(SurfaceGroupingInput, badOptionsAreRefused)
{
  const GridGeometry grid = cameraOf(16, 16);
  const GridPoints points =
      toGridPoints(cameraCloud(grid, [](int, int) { return 1.0; }), grid);
  const auto refuse = [&](const std::function<void(SurfaceGroupingOptions&)>& spoil) {
    SurfaceGroupingOptions options;
    spoil(options);
    EXPECT_THROW(labelsOf(points, options), std::invalid_argument);
  };
  const double nan = std::nan("");
  refuse([](auto& o) { o.points_per_sample = 0.5; });
  refuse([&](auto& o) { o.points_per_sample = nan; });
  refuse([](auto& o) { o.patch_cost = -1.0; });
  refuse([&](auto& o) { o.border_cost = nan; });
  refuse([](auto& o) { o.coefficient_cost = -1.0; });
  refuse([](auto& o) { o.fit_sigmas = 0.0; });
  refuse([&](auto& o) { o.point_sigmas = nan; });
  refuse([](auto& o) { o.crease_angle = 0.0; });
  refuse([](auto& o) { o.min_weight = 0.0F; });
  refuse([](auto& o) { o.jump_sigmas = -1.0F; });
  refuse([](auto& o) { o.threads = 0; });
}

TEST(SurfaceGroupingInput, anotherCloudsGraphIsRefused)
{
  const GridGeometry grid = cameraOf(16, 16);
  const GridPoints points =
      toGridPoints(cameraCloud(grid, [](int, int) { return 1.0; }), grid);
  Labels labels;
  EXPECT_THROW(groupSurfaces(points, GridGraph(), SensorNoise::kinect(), {}, labels),
               std::invalid_argument);
}

} // namespace
