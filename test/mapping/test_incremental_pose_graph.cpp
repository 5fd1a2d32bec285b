// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "pose_graphs.h"
#include "test_data.h"

#include <pcl/mapping/incremental_pose_graph.h>
#include <pcl/mapping/pose_graph_covariance.h>
#include <pcl/mapping/pose_graph_io.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** Gauss-Newton matrix by dense algebra from the public derivatives, rows of node 0
 * left out, inverted. */
Eigen::MatrixXd
denseCovariance(const PoseGraph& graph)
{
  const auto size = static_cast<Eigen::Index>(6 * graph.nodes().size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  for (const auto& [id, factor] : graph.factors()) {
    const auto& edge = std::get<BetweenFactor>(factor.measurement);
    const FactorLinearization part = linearize(
        edge, graph.node(edge.from).T_world_node, graph.node(edge.to).T_world_node);
    Eigen::MatrixXd row = Eigen::MatrixXd::Zero(6, size);
    row.middleCols<6>(static_cast<Eigen::Index>(6 * edge.from)) = part.jacobian_first;
    row.middleCols<6>(static_cast<Eigen::Index>(6 * edge.to)) = part.jacobian_second;
    sum += row.transpose() * edge.information * row;
  }
  return sum.bottomRightCorner(size - 6, size - 6).inverse();
}

TEST(PoseGraphCovariance, IsTheDenseInverse)
{
  const PoseGraph graph = randomGraph(1, {25, 30, 0.05, false, false});
  const Eigen::MatrixXd dense = denseCovariance(graph);
  const PoseGraphCovariance covariance(graph);
  for (const NodeId id : {1, 7, 24}) {
    const auto place = static_cast<Eigen::Index>(6 * (id - 1));
    EXPECT_TRUE(covariance.of(id).isApprox(dense.block<6, 6>(place, place), 1e-8));
  }
  const Eigen::MatrixXd joint = covariance.of({20, 0, 3}); // the anchor is exact
  ASSERT_EQ(joint.rows(), 18);
  EXPECT_TRUE((joint.block<6, 6>(0, 12).isApprox(dense.block<6, 6>(114, 12), 1e-8)));
  EXPECT_TRUE(joint.isApprox(joint.transpose(), 1e-12));
  EXPECT_TRUE(joint.middleRows<6>(6).isZero());
  EXPECT_THROW(covariance.of(99), std::out_of_range);
  EXPECT_THROW(covariance.of({3, 3}), std::invalid_argument);
}

/** One planar edge: the covariance of its end is the inverse information, seen from the
 * anchor in the end's axes. */
TEST(PoseGraphCovariance, OfOneEdge)
{
  PoseGraph graph;
  graph.addNode(0, Eigen::Isometry3d::Identity(), true);
  graph.addNode(1, true);
  BetweenFactor edge{0, 1, Eigen::Isometry3d::Identity(), planarInformation(4.0, 25.0)};
  graph.addFactor(edge);
  optimize(graph);
  const Eigen::Vector3d expected(0.25, 0.25, 0.04);
  EXPECT_TRUE(PoseGraphCovariance(graph).of(1).isApprox(
      Eigen::MatrixXd(expected.asDiagonal()), 1e-12));
}

TEST(PoseGraphCovariance, NeedsDeterminedPoses)
{
  PoseGraph graph;
  graph.addNode(0, Eigen::Isometry3d::Identity());
  graph.addFactor(PositionFactor{0, kOrigin, kOrigin, Eigen::Matrix3d::Identity()});
  EXPECT_THROW(PoseGraphCovariance{graph}, std::invalid_argument);
}

/** Nodes in order, each with its edges to earlier ones. */
void
addNext(IncrementalPoseGraph& growing, const PoseGraph& graph, NodeId id)
{
  growing.addNode(id, graph.node(id).planar);
  for (const FactorId factor : graph.node(id).factors) {
    const auto& edge = std::get<BetweenFactor>(graph.factor(factor).measurement);
    if (std::max(edge.from, edge.to) == id)
      growing.addFactor(edge);
  }
}

double
batchCost(PoseGraph graph)
{
  return optimize(graph).final_cost;
}

TEST(IncrementalPoseGraph, FollowsTheBatchSolution)
{
  for (const bool planar : {false, true}) {
    const PoseGraph graph = randomGraph(2, {120, 80, 0.05, planar, false});
    IncrementalOptions tight;
    tight.relinearize_rotation = tight.relinearize_translation = 1e-4;
    tight.solve_threshold = 0.0;
    IncrementalPoseGraph growing(tight);
    for (const auto& [id, node] : graph.nodes()) {
      addNext(growing, graph, id);
      growing.update();
      if (id % 30 != 29)
        continue;
      for (int k = 0; k < 20; ++k) // until nothing moves any more
        growing.update();
      const double expected = batchCost(growing.graph());
      EXPECT_NEAR(costOf(growing.graph()), expected, 1e-6 * expected) << id;
    }
    const double expected = batchCost(graph);
    EXPECT_NEAR(growing.optimizeAll({}).final_cost, expected, 1e-8 * expected);
    EXPECT_NEAR(costOf(growing.graph()), expected, 1e-8 * expected);
  }
}

TEST(IncrementalPoseGraph, ExactlyIsWithinAMillionthOfTheBatchAtEachUpdate)
{
  for (const bool planar : {false, true}) {
    const PoseGraph graph = randomGraph(5, {100, 60, 0.05, planar, false});
    IncrementalPoseGraph growing(IncrementalOptions::exact());
    for (const auto& [id, node] : graph.nodes()) {
      addNext(growing, graph, id);
      growing.update();
      const double expected = batchCost(growing.graph());
      EXPECT_LE(costOf(growing.graph()), (1.0 + 1e-6) * expected + 1e-9) << id;
    }
  }
}

/** Odometry at the end of a long chain touches a few poses only. */
TEST(IncrementalPoseGraph, WorkIsThatOfWhatIsTouched)
{
  const PoseGraph graph = randomGraph(3, {400, 0, 0.02, false, false});
  IncrementalPoseGraph growing;
  std::size_t most = 0;
  for (const auto& [id, node] : graph.nodes()) {
    addNext(growing, graph, id);
    const IncrementalUpdate update = growing.update();
    if (id > 20)
      most = std::max(most, update.eliminated);
  }
  EXPECT_LT(most, 30U);
  growing.addFactor(BetweenFactor{
      0, 399, graph.node(399).T_world_node, 1e4 * TangentMatrix::Identity()});
  EXPECT_GT(growing.update().solved, 100U);
}

TEST(IncrementalPoseGraph, RemovingWhatWasAddedChangesNothing)
{
  const PoseGraph graph = randomGraph(4, {60, 40, 0.05, false, false});
  IncrementalPoseGraph growing(graph);
  growing.update();
  growing.optimizeAll({});
  const PoseGraph before = growing.graph();
  growing.addNode(1000);
  growing.addFactor(BetweenFactor{10, 1000, kStill, TangentMatrix::Identity()});
  const FactorId wrong = growing.addFactor(BetweenFactor{
      3, 50, Eigen::Isometry3d::Identity(), 1e6 * TangentMatrix::Identity()});
  growing.update();
  EXPECT_GT(poseDifference(before, growing.graph()), 1e-2);
  growing.removeFactor(wrong);
  growing.removeNode(1000);
  for (int k = 0; k < 20; ++k)
    growing.update();
  growing.optimizeAll({});
  EXPECT_LT(poseDifference(before, growing.graph()), 1e-4);
  EXPECT_NEAR(costOf(growing.graph()), costOf(before), 1e-7 * costOf(before));
}

/** Parts join and come apart; each has its own gauge all the time. */
TEST(IncrementalPoseGraph, PartsJoinAndComeApart)
{
  IncrementalPoseGraph growing;
  const TangentMatrix one = TangentMatrix::Identity();
  BetweenFactor step{0, 1, Eigen::Isometry3d::Identity(), one};
  step.T_from_to.translation().x() = 1.0;
  for (NodeId id = 0; id < 20; ++id)
    growing.addNode(id);
  for (NodeId id = 1; id < 20; ++id)
    if (id != 10) {
      step.from = id - 1;
      step.to = id;
      growing.addFactor(step);
      growing.update();
    }
  EXPECT_NEAR(growing.pose(19).translation().x(), 9.0, 1e-9);
  step.from = 9;
  step.to = 10;
  const FactorId joint = growing.addFactor(step);
  for (int k = 0; k < 10; ++k)
    growing.update();
  EXPECT_NEAR(growing.pose(19).translation().x() - growing.pose(0).translation().x(),
              19.0,
              1e-6);
  growing.removeFactor(joint);
  growing.addFactor(PriorFactor{15, Eigen::Isometry3d::Identity(), one});
  for (int k = 0; k < 10; ++k)
    growing.update();
  EXPECT_NEAR(growing.pose(15).translation().norm(), 0.0, 1e-6);
  EXPECT_NEAR(growing.pose(10).translation().x(), -5.0, 1e-6);
  EXPECT_LT(costOf(growing.graph()), 1e-10);
}

TEST(IncrementalPoseGraph, WeightsAndFixedNodes)
{
  PoseGraph graph = randomGraph(5, {40, 20, 0.05, false, false});
  const FactorId wrong = graph.addFactor(BetweenFactor{
      3, 30, Eigen::Isometry3d::Identity(), 1e6 * TangentMatrix::Identity()});
  IncrementalPoseGraph growing(graph);
  growing.update();
  growing.setWeight(wrong, 0.0);
  growing.setFixed(0, true);
  for (int k = 0; k < 20; ++k)
    growing.update();
  graph.setWeight(wrong, 0.0);
  const double expected = batchCost(graph);
  EXPECT_NEAR(growing.optimizeAll({}).final_cost, expected, 1e-7 * expected);
  EXPECT_TRUE(growing.pose(0).isApprox(graph.node(0).T_world_node, 1e-12));
  EXPECT_THROW(growing.covariance({0}), std::invalid_argument);
}

/** Against the batch one; the anchor gives way by a millionth. */
TEST(IncrementalPoseGraph, Covariances)
{
  const PoseGraph graph = randomGraph(6, {50, 40, 0.05, false, false});
  IncrementalPoseGraph growing;
  for (const auto& [id, node] : graph.nodes()) {
    addNext(growing, graph, id);
    growing.update();
  }
  growing.optimizeAll({});
  const Eigen::MatrixXd expected = PoseGraphCovariance(growing.graph()).of({49, 12});
  EXPECT_TRUE(growing.covariance({49, 12}).isApprox(expected, 1e-4));
}

TEST(IncrementalPoseGraph, PoorlyTiedNodesDoNotStopIt)
{
  IncrementalPoseGraph growing;
  growing.addNode(0);
  growing.addFactor(
      PositionFactor{0, {1.0, 2.0, 3.0}, kOrigin, Eigen::Matrix3d::Identity()});
  growing.update();
  growing.update();
  EXPECT_TRUE(growing.pose(0).translation().isApprox(Eigen::Vector3d(1, 2, 3), 1e-6));
}

TEST(IncrementalPoseGraph, RefusesBadOptions)
{
  IncrementalOptions options;
  options.relinearize_rotation = -1.0;
  EXPECT_THROW(IncrementalPoseGraph{options}, std::invalid_argument);
  options = {};
  options.max_steps = 0;
  EXPECT_THROW(IncrementalPoseGraph{options}, std::invalid_argument);
}

TEST(IncrementalPoseGraph, PublicGraphs)
{
  PCL_NURBS_DATA_OR_SKIP(folder, "g2o");
  for (const char* name : {"kitti_07.g2o", "smallGrid3D.g2o"}) {
    const PoseGraph graph = readG2o((folder / name).string()).graph;
    IncrementalPoseGraph growing;
    for (const auto& [id, node] : graph.nodes()) {
      addNext(growing, graph, id);
      growing.update();
    }
    const double near = costOf(growing.graph());
    const double best = growing.optimizeAll({}).final_cost;
    EXPECT_NEAR(best, batchCost(graph), 1e-6 * best);
    EXPECT_LT(near, 1.1 * best) << name;
  }
}

} // namespace
