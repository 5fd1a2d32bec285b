// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Merges of nodes: group sums are those of their nodes, no merge makes it worse.

#include "border_agglomeration.h"
#include "noise_dispersion.h"
#include "surface_merging.h"

#include "grid_clouds.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

const GridGeometry kCamera =
    GridGeometry::pinhole(160, 120, {131.0, 131.0, 79.5, 59.5});
constexpr BlockSize kBlock{8, 8};

/** Bumps and steps under noise, and the nodes of it. */
struct Scene {
  explicit Scene(unsigned seed, int correlated = 1)
      : points(toGridPoints(cloudOf(seed, correlated), kCamera)),
        graph(graphOf(points)),
        chart(points, SensorNoise::kinect(), graph)
  {
    edges.emplace(points, graph, SensorNoise::kinect(), ConnectedGroupsOptions());
    nodes.emplace(points, *edges, chart);
    nodes->addBlocks(kBlock, 2.0, 1);
  }

  static GridGraph
  graphOf(const GridPoints& points)
  {
    GridGraph graph;
    graph.build(points, SensorNoise::kinect());
    graph.setWeights();
    return graph;
  }

  static PointCloud<PointXYZ>
  cloudOf(unsigned seed, int correlated)
  {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::map<std::pair<int, int>, double> errors;
    return cameraCloud(kCamera, [&](int column, int row) {
      const double step = seed != 0 && column > 90 ? 0.02 : 0.0;
      const double bump = seed != 0 ? 0.03 * std::sin(0.1 * row + seed) : 0.0;
      const double depth = 1.2 + step + bump;
      const auto where = std::make_pair(column / correlated, row / correlated);
      const auto found = errors.try_emplace(where, normal(random)).first;
      return depth + SensorNoise::kinect().sigma(depth) * found->second;
    });
  }

  GridPoints points;
  GridGraph graph;
  ViewChart chart;
  std::optional<KeptEdges> edges;
  std::optional<SurfaceNodes> nodes;
};

TEST(SurfaceMerging, groupSumsAreThoseOfTheirNodes)
{
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Scene scene(seed);
    const SurfaceCriterion criterion(scene.chart, {}, 1.0);
    SurfaceMerging merging(criterion);
    merging.add(*scene.nodes, scene.nodes->links(0, 1));
    merging.mergeWhileBetter();
    std::map<std::uint32_t, ViewSums> sums;
    for (std::uint32_t node = 0; node < scene.nodes->count(); ++node)
      sums[merging.find(node)] += scene.nodes->sums(node);
    EXPECT_LT(sums.size(), scene.nodes->count());
    EXPECT_GT(sums.size(), 1U);
    for (const auto& [root, sum] : sums) {
      const CostedModel model = criterion.best(sum);
      EXPECT_EQ(merging.group(root).sums.count(), sum.count());
      EXPECT_NEAR(merging.group(root).model.cost, model.cost, 1e-5 * model.cost);
    }
  }
}

class MergingCriteria : public testing::TestWithParam<GroupingCriterion> {};

TEST_P(MergingCriteria, mergesLowerTheCriterion)
{
  SurfaceGroupingOptions options;
  options.criterion = GetParam();
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    const Scene scene(seed);
    const SurfaceCriterion criterion(scene.chart, options, 1.0);
    SurfaceMerging merging(criterion);
    merging.add(*scene.nodes, scene.nodes->links(0, 1));
    double before = merging.totalCost();
    std::uint32_t steps = 0;
    while (merging.mergeOnce()) {
      const double after = merging.totalCost();
      ASSERT_LE(after, before + 1e-9 * std::abs(before));
      before = after;
      ++steps;
    }
    EXPECT_GT(steps, 100U);
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         MergingCriteria,
                         testing::Values(GroupingCriterion::AIC,
                                         GroupingCriterion::AICc,
                                         GroupingCriterion::BIC,
                                         GroupingCriterion::DescriptionLength));

TEST(NoiseDispersion, isOneForIndependentNoise)
{
  const Scene scene(0);
  EXPECT_NEAR(noiseDispersion(kCamera, *scene.nodes, scene.chart, kBlock), 0.9, 0.25);
}

TEST(NoiseDispersion, countsPixelsThatErrAlike)
{
  const Scene scene(0, 3); // 9 pixels of one error each
  EXPECT_NEAR(noiseDispersion(kCamera, *scene.nodes, scene.chart, kBlock), 8.0, 3.0);
}

TEST(BorderAgglomeration, joinsOverSmoothBordersOnly)
{
  BorderAgglomeration agglomeration(4);
  agglomeration.add(0, 1, 10, true);
  agglomeration.add(1, 2, 10, false);
  agglomeration.add(2, 3, 7, true);
  agglomeration.add(2, 3, 3, false);
  DisjointSets sets(4);
  agglomeration.joinInto(sets, 0.6);
  EXPECT_EQ(sets.find(1), 0U);
  EXPECT_EQ(sets.find(2), 2U);
  EXPECT_EQ(sets.find(3), 2U);
}

TEST(BorderAgglomeration, aDoubtfulPieceDoesNotOutvoteTheBorder)
{
  // A sliver (2) leans on both of two surfaces that meet in a fold.
  BorderAgglomeration agglomeration(3);
  agglomeration.add(0, 1, 50, false);
  agglomeration.add(0, 2, 8, true);
  agglomeration.add(1, 2, 5, true);
  agglomeration.add(1, 2, 2, false);
  DisjointSets sets(3);
  agglomeration.joinInto(sets, 0.6);
  EXPECT_EQ(sets.find(2), 0U);
  EXPECT_EQ(sets.find(1), 1U);
}

} // namespace
