// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

// The graph as a container, and the laws of its factors.

#include "pose_graphs.h"

#include <pcl/mapping/pose_graph_cost.h>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** One factor of each kind with random content, about nodes 1 and 2. */
std::vector<Measurement>
randomFactors(std::mt19937& generator)
{
  const Eigen::Vector3d a = randomMotion(generator, 2.0, 0.0).translation();
  const Eigen::Vector3d b = randomMotion(generator, 2.0, 0.0).translation();
  return {BetweenFactor{
              1, 2, randomMotion(generator, 2.0, 2.0), randomInformation<6>(generator)},
          PriorFactor{
              1, randomMotion(generator, 2.0, 2.0), randomInformation<6>(generator)},
          PositionFactor{1, a, b, randomInformation<3>(generator)},
          DirectionFactor{
              1, a.normalized(), b.normalized(), randomInformation<3>(generator)}};
}

/** Central difference of the error with the exponential map itself. */
Eigen::MatrixXd
numericJacobian(const Measurement& measurement,
                const Eigen::Isometry3d& first,
                const Eigen::Isometry3d& second,
                bool by_second)
{
  constexpr double kStep = 1e-5;
  Eigen::MatrixXd result;
  for (Eigen::Index k = 0; k < 6; ++k) {
    const auto moved = [&](double step) {
      const Eigen::Isometry3d by = exponential(step * Tangent::Unit(k));
      return linearize(measurement,
                       by_second ? first : first * by,
                       by_second ? second * by : second)
          .error;
    };
    const Eigen::VectorXd column = (moved(kStep) - moved(-kStep)) / (2.0 * kStep);
    result.conservativeResize(column.size(), 6);
    result.col(k) = column;
  }
  return result;
}

TEST(PoseFactor, DerivativesAreThoseOfRightPerturbations)
{
  std::mt19937 generator(1);
  for (int trial = 0; trial < 50; ++trial)
    for (const Measurement& measurement : randomFactors(generator)) {
      const Eigen::Isometry3d first = randomMotion(generator, 3.0, 3.0);
      const Eigen::Isometry3d second = randomMotion(generator, 3.0, 3.0);
      const FactorLinearization exact = linearize(measurement, first, second);
      EXPECT_TRUE(exact.jacobian_first.isApprox(
          numericJacobian(measurement, first, second, false), 1e-6))
          << measurement.index();
      if (nodesOf(measurement).size() == 2)
        EXPECT_TRUE(exact.jacobian_second.isApprox(
            numericJacobian(measurement, first, second, true), 1e-6));
      else
        EXPECT_EQ(exact.jacobian_second.size(), 0);
    }
}

TEST(PoseFactor, ErrorIsZeroAtTheTruth)
{
  std::mt19937 generator(2);
  const Eigen::Isometry3d first = randomMotion(generator, 3.0, 3.0);
  const Eigen::Isometry3d second = randomMotion(generator, 3.0, 3.0);
  const Eigen::Vector3d point(0.3, -0.2, 1.0);
  const Eigen::Vector3d up = first.linear().transpose() * Eigen::Vector3d::UnitZ();
  for (const Measurement& measurement :
       {Measurement(
            BetweenFactor{1, 2, first.inverse() * second, TangentMatrix::Identity()}),
        Measurement(PriorFactor{1, first, TangentMatrix::Identity()}),
        Measurement(
            PositionFactor{1, first * point, point, Eigen::Matrix3d::Identity()}),
        Measurement(DirectionFactor{
            1, Eigen::Vector3d::UnitZ(), up, Eigen::Matrix3d::Identity()})})
    EXPECT_LT(linearize(measurement, first, second).error.norm(), 1e-14);
}

/** Translation in the measured frame, then twice the sine of half of the angle. */
TEST(PoseFactor, ErrorOfAKnownMotion)
{
  const double angle = 0.6;
  BetweenFactor factor;
  factor.T_from_to.linear() =
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  factor.T_from_to.translation() = Eigen::Vector3d(1, 0, 0);
  Eigen::Isometry3d first = Eigen::Isometry3d::Identity();
  first.translation() = Eigen::Vector3d(5, 5, 5);
  Eigen::Isometry3d second = first * factor.T_from_to;
  second.translation() += Eigen::Vector3d(0.1, 0.2, 0.3); // seen after the turn
  second.linear() =
      second.linear() *
      Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
  Tangent expected;
  expected << 0.2, -0.1, 0.3, 2.0 * std::sin(angle / 2), 0.0, 0.0;
  EXPECT_TRUE(linearize(factor, first, second).error.isApprox(expected, 1e-12));
}

TEST(PoseGraphCost, IsErrorTimesInformationTimesError)
{
  std::mt19937 generator(3);
  for (const Measurement& measurement : randomFactors(generator)) {
    PoseGraph graph;
    graph.addNode(1, randomMotion(generator, 1.0, 1.0));
    graph.addNode(2, randomMotion(generator, 1.0, 1.0));
    const FactorId id = graph.addFactor(measurement);
    const Eigen::VectorXd error =
        linearize(measurement, graph.node(1).T_world_node, graph.node(2).T_world_node)
            .error;
    const double expected = std::visit(
        [&](const auto& factor) { return error.dot(factor.information * error); },
        measurement);
    EXPECT_NEAR(costOf(graph), expected, 1e-10 * expected);
    graph.setWeight(id, 0.25);
    EXPECT_NEAR(costOf(graph, id), 0.25 * expected, 1e-10 * expected);
    EXPECT_NEAR(costOf(graph), 0.25 * expected, 1e-10 * expected);
  }
}

/** By its definition with matrices. */
TEST(PoseGraphCost, SeSyncsForm)
{
  for (const bool planar : {false, true}) {
    const PoseGraph truth = randomGraph(4, {20, 20, 0.1, planar, false});
    PoseGraph graph = truth;
    disturb(graph, 5, 0.5, 0.5);
    double expected = 0.0;
    const Eigen::Index d = planar ? 2 : 3;
    for (const auto& [id, factor] : graph.factors()) {
      const auto& edge = std::get<BetweenFactor>(factor.measurement);
      const Eigen::Isometry3d& a = graph.node(edge.from).T_world_node;
      const Eigen::Isometry3d& b = graph.node(edge.to).T_world_node;
      const Eigen::MatrixXd file_rotation = // g2o's is about half of the angle
          4.0 * edge.information.bottomRightCorner<3, 3>();
      const double tau =
          static_cast<double>(d) /
          Eigen::MatrixXd(edge.information.topLeftCorner(d, d)).inverse().trace();
      const double kappa =
          planar ? edge.information(5, 5) : 1.5 / file_rotation.inverse().trace();
      const Eigen::MatrixXd turn =
          (b.linear() - a.linear() * edge.T_from_to.linear()).topLeftCorner(d, d);
      const Eigen::Vector3d step =
          b.translation() - a.translation() - a.linear() * edge.T_from_to.translation();
      expected += kappa * turn.squaredNorm() + tau * step.squaredNorm();
    }
    EXPECT_NEAR(costOf(graph, PoseGraphCost::SeSync), expected, 1e-9 * expected);
  }
}

/** The cost does not change with the world's frame. */
TEST(PoseGraphCost, GaugeInvariance)
{
  PoseGraph graph = randomGraph(6, {30, 30, 0.1, false, false});
  std::mt19937 generator(7);
  const Eigen::Isometry3d motion = randomMotion(generator, 100.0, 3.0);
  PoseGraph moved = graph;
  for (const auto& [id, node] : graph.nodes())
    moved.setPose(id, motion * node.T_world_node);
  for (const auto form : {PoseGraphCost::Information, PoseGraphCost::SeSync})
    EXPECT_NEAR(costOf(moved, form), costOf(graph, form), 1e-9 * costOf(graph, form));
}

TEST(PoseGraph, RemovingWhatWasAddedChangesNothing)
{
  PoseGraph graph = randomGraph(8);
  const PoseGraph before = graph;
  const double cost = costOf(graph);
  graph.addNode(1000, Eigen::Isometry3d::Identity());
  const FactorId one =
      graph.addFactor(BetweenFactor{3, 1000, kStill, TangentMatrix::Identity()});
  const FactorId two =
      graph.addFactor(PriorFactor{4, kStill, TangentMatrix::Identity()});
  EXPECT_LT(one, two);
  graph.removeFactor(two);
  graph.removeNode(1000);
  EXPECT_EQ(graph.factors().count(one), 0U);
  EXPECT_EQ(graph.nodes().size(), before.nodes().size());
  EXPECT_EQ(graph.factors().size(), before.factors().size());
  for (const auto& [id, node] : before.nodes())
    EXPECT_EQ(graph.node(id).factors, node.factors);
  EXPECT_EQ(costOf(graph), cost);
  EXPECT_GT(graph.addFactor(PriorFactor{4, kStill, TangentMatrix::Identity()}), two);
}

TEST(PoseGraph, Components)
{
  PoseGraph graph;
  for (const NodeId id : {7, 3, 5, 9, 1})
    graph.addNode(id, Eigen::Isometry3d::Identity());
  const FactorId joint =
      graph.addFactor(BetweenFactor{9, 3, kStill, TangentMatrix::Identity()});
  graph.addFactor(BetweenFactor{5, 7, kStill, TangentMatrix::Identity()});
  using Parts = std::vector<std::vector<NodeId>>;
  EXPECT_EQ(graph.components(), (Parts{{1}, {3, 9}, {5, 7}}));
  graph.setWeight(joint, 0.0);
  EXPECT_EQ(graph.components(), (Parts{{1}, {3}, {5, 7}, {9}}));
}

TEST(PoseGraph, RefusesWhatIsNoMeasurement)
{
  PoseGraph graph;
  graph.addNode(1, Eigen::Isometry3d::Identity());
  graph.addNode(2);
  const TangentMatrix one = TangentMatrix::Identity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TangentMatrix indefinite = one;
  indefinite(2, 2) = -1.0;
  TangentMatrix skew = one;
  skew(0, 1) = 0.5;
  Eigen::Isometry3d mirror = Eigen::Isometry3d::Identity();
  mirror.linear()(0, 0) = -1.0;
  Eigen::Isometry3d lost = Eigen::Isometry3d::Identity();
  lost.translation().x() = nan;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  for (const Measurement& bad :
       {Measurement(BetweenFactor{1, 1, kStill, one}),
        Measurement(BetweenFactor{1, 2, kStill, indefinite}),
        Measurement(BetweenFactor{1, 2, kStill, skew}),
        Measurement(BetweenFactor{1, 2, kStill, TangentMatrix::Zero()}),
        Measurement(BetweenFactor{1, 2, kStill, nan * one}),
        Measurement(BetweenFactor{1, 2, mirror, one}),
        Measurement(PriorFactor{1, lost, one}),
        Measurement(PositionFactor{1, nan * x, x, Eigen::Matrix3d::Identity()}),
        Measurement(DirectionFactor{1, 2.0 * x, x, Eigen::Matrix3d::Identity()})}) {
    EXPECT_FALSE(flawOf(bad).empty());
    EXPECT_THROW(graph.addFactor(bad), std::invalid_argument);
  }
  EXPECT_TRUE(graph.factors().empty());
  EXPECT_THROW(graph.addFactor(BetweenFactor{1, 3, kStill, one}), std::out_of_range);
  EXPECT_THROW(graph.addNode(1, Eigen::Isometry3d::Identity()), std::invalid_argument);
  EXPECT_THROW(graph.addNode(4, mirror), std::invalid_argument);
  EXPECT_THROW(graph.setFixed(2, true), std::invalid_argument);
  EXPECT_THROW(graph.removeNode(3), std::out_of_range);
  EXPECT_THROW(graph.setWeight(0, 1.0), std::out_of_range);
  EXPECT_EQ(graph.nodes().size(), 2U);
}

TEST(PoseGraph, PlanarNodesStayInThePlane)
{
  PoseGraph graph;
  Eigen::Isometry3d above = Eigen::Isometry3d::Identity();
  above.translation().z() = 1.0;
  EXPECT_THROW(graph.addNode(1, above, true), std::invalid_argument);
  graph.addNode(1, Eigen::Isometry3d::Identity(), true);
  EXPECT_THROW(graph.setPose(1, above), std::invalid_argument);
}

} // namespace
