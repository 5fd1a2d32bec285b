// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "pose_graphs.h"

#include <pcl/mapping/pose_graph_solver.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

PoseGraphOptions
optionsOf(PoseGraphMethod method, PoseGraphCost cost = PoseGraphCost::Information)
{
  PoseGraphOptions options;
  options.method = method;
  options.cost = cost;
  return options;
}

const PoseGraphMethod kMethods[] = {PoseGraphMethod::Ceres,
                                    PoseGraphMethod::Multifrontal};

TEST(OptimizePoseGraph, WithoutNoiseTheTruthIsFound)
{
  for (const bool planar : {false, true})
    for (const PoseGraphMethod method : kMethods) {
      const PoseGraph truth = randomGraph(1, {60, 40, 0.0, planar, false});
      PoseGraph graph = truth;
      disturb(graph, 2, 0.3, 0.3);
      const PoseGraphSummary summary = optimize(graph, optionsOf(method));
      EXPECT_TRUE(summary.converged);
      EXPECT_EQ(summary.components, 1U);
      EXPECT_EQ(summary.anchors, std::vector<NodeId>{0});
      EXPECT_LT(summary.final_cost, 1e-12 * summary.initial_cost);
      EXPECT_LT(poseDifference(graph, truth), 1e-6);
    }
}

TEST(OptimizePoseGraph, BothMethodsFindTheSameMinimum)
{
  for (const bool planar : {false, true})
    for (const auto cost : {PoseGraphCost::Information, PoseGraphCost::SeSync}) {
      PoseGraph one = randomGraph(3, {80, 60, 0.1, planar, false});
      PoseGraph other = one;
      const double a = optimize(one, optionsOf(kMethods[0], cost)).final_cost;
      const double b = optimize(other, optionsOf(kMethods[1], cost)).final_cost;
      EXPECT_NEAR(a, b, 1e-8 * a);
      EXPECT_NEAR(a, costOf(one, cost), 1e-12 * a);
      EXPECT_LT(poseDifference(one, other), 1e-3);
    }
}

/** At a minimum no small move of any pose lowers the cost. */
TEST(OptimizePoseGraph, IsAMinimum)
{
  PoseGraph graph = randomGraph(4, {25, 20, 0.1, false, false});
  const double cost =
      optimize(graph, optionsOf(PoseGraphMethod::Multifrontal)).final_cost;
  for (const auto& [id, node] : PoseGraph::Nodes(graph.nodes()))
    for (Eigen::Index k = 0; k < 6; ++k)
      for (const double step : {-1e-3, 1e-3}) {
        PoseGraph moved = graph;
        moved.setPose(id, node.T_world_node * exponential(step * Tangent::Unit(k)));
        EXPECT_GT(costOf(moved), cost);
      }
}

TEST(OptimizePoseGraph, PartsAreSolvedSideBySide)
{
  PoseGraph graph = randomGraph(5, {20, 15, 0.05, false, false});
  PoseGraph alone = graph;
  const PoseGraph second = randomGraph(6, {20, 15, 0.05, true, false});
  for (const auto& [id, node] : second.nodes())
    graph.addNode(100 + id, node.T_world_node, true);
  for (const auto& [id, factor] : second.factors()) {
    BetweenFactor edge = std::get<BetweenFactor>(factor.measurement);
    edge.from += 100;
    edge.to += 100;
    graph.addFactor(edge);
  }
  graph.addNode(500, Eigen::Isometry3d::Identity());
  PoseGraph other = second;
  for (const PoseGraphMethod method : kMethods) {
    const double expected = optimize(alone, optionsOf(method)).final_cost +
                            optimize(other, optionsOf(method)).final_cost;
    PoseGraph both = graph;
    const PoseGraphSummary summary = optimize(both, optionsOf(method));
    EXPECT_EQ(summary.components, 3U);
    EXPECT_EQ(summary.anchors, (std::vector<NodeId>{0, 100}));
    EXPECT_NEAR(summary.final_cost, expected, 1e-7 * expected);
  }
}

TEST(OptimizePoseGraph, FixedNodesStay)
{
  PoseGraph graph = randomGraph(7, {30, 20, 0.1, false, false});
  std::mt19937 generator(8);
  for (const NodeId id : {4, 20}) {
    graph.setPose(id, graph.node(id).T_world_node * randomMotion(generator, 0.2, 0.1));
    graph.setFixed(id, true);
  }
  const PoseGraph before = graph;
  const PoseGraphSummary summary = optimize(graph);
  EXPECT_TRUE(summary.anchors.empty());
  EXPECT_EQ(graph.node(4).T_world_node.matrix(), before.node(4).T_world_node.matrix());
  EXPECT_EQ(graph.node(20).T_world_node.matrix(),
            before.node(20).T_world_node.matrix());
  EXPECT_LT(summary.final_cost, summary.initial_cost);
}

/** Three positions and no anchor: the graph is turned and moved into their frame. */
TEST(OptimizePoseGraph, PositionsAndGravityTieTheGraphDown)
{
  std::mt19937 generator(9);
  const PoseGraph local = randomGraph(10, {30, 20, 0.0, false, false});
  const Eigen::Isometry3d frame = randomMotion(generator, 5.0, 0.4);
  const Eigen::Vector3d antenna(0.1, 0.2, 1.5);
  PoseGraph graph = local;
  for (const NodeId id : {0, 9, 17, 29}) {
    const Eigen::Isometry3d truth = frame * local.node(id).T_world_node;
    graph.addFactor(
        PositionFactor{id, truth * antenna, antenna, Eigen::Matrix3d::Identity()});
    graph.addFactor(
        DirectionFactor{id,
                        Eigen::Vector3d::UnitZ(),
                        truth.linear().transpose() * Eigen::Vector3d::UnitZ(),
                        Eigen::Matrix3d::Identity()});
  }
  for (const PoseGraphMethod method : kMethods) {
    PoseGraph solved = graph;
    const PoseGraphSummary summary = optimize(solved, optionsOf(method));
    EXPECT_TRUE(summary.anchors.empty());
    EXPECT_LT(summary.final_cost, 1e-10);
    for (const auto& [id, node] : local.nodes())
      EXPECT_LT(
          (solved.node(id).T_world_node.matrix() - (frame * node.T_world_node).matrix())
              .cwiseAbs()
              .maxCoeff(),
          1e-4);
  }
}

TEST(OptimizePoseGraph, SmallGraphs)
{
  for (const PoseGraphMethod method : kMethods) {
    PoseGraph graph;
    EXPECT_EQ(optimize(graph, optionsOf(method)).final_cost, 0.0);
    graph.addNode(3);
    const PoseGraphSummary summary = optimize(graph, optionsOf(method));
    EXPECT_EQ(summary.final_cost, 0.0);
    EXPECT_TRUE(summary.converged);
    graph.addNode(4);
    BetweenFactor edge{4, 3, Eigen::Isometry3d::Identity(), TangentMatrix::Identity()};
    edge.T_from_to.translation().x() = 2.0;
    graph.addFactor(edge);
    EXPECT_LT(optimize(graph, optionsOf(method)).final_cost, 1e-20);
    EXPECT_TRUE(graph.node(4).has_estimate);
  }
}

/** Edges that contradict each other end in a finite compromise. */
TEST(OptimizePoseGraph, ContradictingLoops)
{
  PoseGraph graph = randomGraph(11, {30, 10, 0.01, false, true});
  std::mt19937 generator(12);
  for (int k = 0; k < 10; ++k)
    graph.addFactor(BetweenFactor{static_cast<NodeId>(k),
                                  static_cast<NodeId>(29 - k),
                                  randomMotion(generator, 50.0, 3.0),
                                  1e4 * TangentMatrix::Identity()});
  for (const PoseGraphMethod method : kMethods) {
    PoseGraph solved = graph;
    const PoseGraphSummary summary = optimize(solved, optionsOf(method));
    EXPECT_TRUE(std::isfinite(summary.final_cost));
    EXPECT_LT(summary.final_cost, summary.initial_cost);
  }
}

TEST(OptimizePoseGraph, StopsWhenAsked)
{
  PoseGraph graph = randomGraph(13, {40, 30, 0.3, false, false});
  disturb(graph, 14, 1.0, 1.0);
  for (const PoseGraphMethod method : kMethods) {
    PoseGraph stopped = graph;
    PoseGraphOptions options = optionsOf(method);
    options.interrupted = [] { return true; };
    EXPECT_LE(optimize(stopped, options).iterations, 1);
    options.max_iterations = -1;
    EXPECT_THROW(optimize(stopped, options), std::invalid_argument);
  }
}

TEST(PoseGraphStart, AlongTheEdges)
{
  const PoseGraph truth = randomGraph(15);
  for (const auto start : {&initializeFromOdometry, &completeEstimates}) {
    PoseGraph graph = truth;
    for (const auto& [id, node] : truth.nodes())
      graph.clearPose(id);
    start(graph);
    EXPECT_LT(poseDifference(graph, truth), 1e-9);
  }
}

TEST(PoseGraphStart, ChordalIsExactWithoutNoise)
{
  for (const bool planar : {false, true}) {
    const PoseGraph truth = randomGraph(16, {60, 40, 0.0, planar, false});
    PoseGraph graph = truth;
    initializeRandomly(graph, 17);
    graph.setPose(0, truth.node(0).T_world_node); // the anchor
    initializeChordal(graph);
    EXPECT_LT(poseDifference(graph, truth), 1e-8);
  }
}

TEST(PoseGraphStart, RandomIsTheSameForTheSameSeed)
{
  const PoseGraph graph = randomGraph(18);
  PoseGraph a = graph;
  PoseGraph b = graph;
  PoseGraph c = graph;
  initializeRandomly(a, 1);
  initializeRandomly(b, 1);
  initializeRandomly(c, 2);
  EXPECT_EQ(poseDifference(a, b), 0.0);
  EXPECT_GT(poseDifference(a, c), 0.1);
}

} // namespace
