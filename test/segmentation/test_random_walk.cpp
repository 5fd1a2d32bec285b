// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The random walk against dense matrices, closed forms and recomputation.

#include <pcl/segmentation/random_walk.h>

#include "grid_clouds.h"
#include "random_graphs.h"

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** Transition matrix of the walk along the selected edges by its definition. */
Eigen::MatrixXd
transitions(const WeightedGraph& graph, const std::vector<bool>& selected)
{
  const Eigen::VectorXd weights = denseWeights(graph).rowwise().sum();
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(weights.size(), weights.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const WeightedEdge& edge = graph.edges[e];
    for (const auto& [from, to] :
         {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)})
      p(from, selected[e] ? to : from) += edge.weight / weights(from);
  }
  return p;
}

/** Entropy rate by its definition. */
double
denseEntropyRate(const Eigen::MatrixXd& p, const Eigen::VectorXd& mu)
{
  double rate = 0.0;
  for (Eigen::Index i = 0; i < p.rows(); ++i)
    for (Eigen::Index j = 0; j < p.cols(); ++j)
      if (p(i, j) > 0.0)
        rate -= mu(i) * p(i, j) * std::log(p(i, j));
  return rate;
}

std::vector<bool>
allEdges(const WeightedGraph& graph)
{
  return std::vector<bool>(graph.edges.size(), true);
}

Eigen::Map<const Eigen::VectorXd>
asVector(const std::vector<double>& values)
{
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

WeightedGraph
completeGraph(std::uint32_t nodes, float weight)
{
  WeightedGraph graph = randomGraph(nodes, 1.0, 1);
  for (WeightedEdge& edge : graph.edges)
    edge.weight = weight;
  return graph;
}

class WalkLaws : public testing::TestWithParam<unsigned> {
protected:
  WeightedGraph graph_ = randomGraph(5 + GetParam() % 17, 0.3, GetParam());
};

TEST_P(WalkLaws, stepsAreTheTransitionMatrix)
{
  const Eigen::MatrixXd p = transitions(graph_, allEdges(graph_));
  const std::vector<StepProbabilities> steps = stepProbabilities(graph_);
  for (std::size_t e = 0; e < steps.size(); ++e) {
    EXPECT_NEAR(steps[e].forward, p(graph_.edges[e].a, graph_.edges[e].b), 1e-14);
    EXPECT_NEAR(steps[e].backward, p(graph_.edges[e].b, graph_.edges[e].a), 1e-14);
  }
  EXPECT_NEAR((p.rowwise().sum().array() - 1.0).abs().maxCoeff(), 0.0, 1e-12);
}

TEST_P(WalkLaws, stationaryDistributionIsTheEigenvector)
{
  // Left eigenvector of the eigenvalue 1, by elimination: (P' - I) mu = 0, sum mu = 1.
  const Eigen::MatrixXd p = transitions(graph_, allEdges(graph_));
  Eigen::MatrixXd system =
      p.transpose() - Eigen::MatrixXd::Identity(p.rows(), p.cols());
  system.row(0).setOnes();
  const Eigen::VectorXd mu =
      system.fullPivLu().solve(Eigen::VectorXd::Unit(p.rows(), 0));
  const std::vector<double> found = stationaryDistribution(graph_);
  EXPECT_LT((asVector(found) - mu).cwiseAbs().maxCoeff(), 1e-10);
  // And for each set of edges: what is cut stays where it is.
  std::mt19937 random(GetParam());
  std::vector<bool> selected = allEdges(graph_);
  for (std::size_t e = 0; e < selected.size(); ++e)
    selected[e] = random() % 2 == 0;
  const Eigen::VectorXd next =
      transitions(graph_, selected).transpose() * asVector(found);
  EXPECT_LT((next - asVector(found)).cwiseAbs().maxCoeff(), 1e-14);
}

TEST_P(WalkLaws, entropyRateIsItsDefinition)
{
  const std::vector<double> mu = stationaryDistribution(graph_);
  std::mt19937 random(GetParam());
  std::vector<bool> selected = allEdges(graph_);
  EXPECT_NEAR(entropyRate(graph_),
              denseEntropyRate(transitions(graph_, selected), asVector(mu)),
              1e-12);
  for (int trial = 0; trial < 5; ++trial) {
    for (std::size_t e = 0; e < selected.size(); ++e)
      selected[e] = random() % 3 == 0;
    EXPECT_NEAR(entropyRate(graph_, selected),
                denseEntropyRate(transitions(graph_, selected), asVector(mu)),
                1e-12);
  }
}

TEST_P(WalkLaws, differenceOfConvexFunctionsIsTheEntropyRate)
{
  const ConvexPair pair = convexPair(graph_);
  EXPECT_NEAR(pair.g - pair.h, entropyRate(graph_), 1e-12);
}

TEST_P(WalkLaws, bothFunctionsAreConvex)
{
  // Convex in the normalised weights: between two graphs of the same total weight.
  WeightedGraph other = randomGraph(5 + GetParam() % 17, 0.3, GetParam());
  std::mt19937 random(GetParam() + 1000);
  for (WeightedEdge& edge : other.edges)
    edge.weight = static_cast<float>(random() % 1000 + 1);
  const auto total = [](const WeightedGraph& graph) {
    return asVector(nodeWeights(graph)).sum();
  };
  const double ratio = total(graph_) / total(other);
  WeightedGraph middle = graph_;
  for (std::size_t e = 0; e < middle.edges.size(); ++e) {
    other.edges[e].weight *= static_cast<float>(ratio);
    middle.edges[e].weight = 0.5F * (graph_.edges[e].weight + other.edges[e].weight);
  }
  const ConvexPair first = convexPair(graph_);
  const ConvexPair second = convexPair(other);
  const ConvexPair between = convexPair(middle);
  EXPECT_LE(between.g, 0.5 * (first.g + second.g) + 1e-6);
  EXPECT_LE(between.h, 0.5 * (first.h + second.h) + 1e-6);
}

TEST_P(WalkLaws, gainIsTheDifference)
{
  EdgeSubsetWalk walk(graph_);
  std::vector<bool> selected(graph_.edges.size(), false);
  std::vector<std::uint32_t> order(graph_.edges.size());
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::mt19937(GetParam()));
  for (const std::uint32_t e : order) {
    const double before = entropyRate(graph_, selected);
    EXPECT_NEAR(walk.entropyRate(), before, 1e-12);
    const double gain = walk.gain(graph_.edges[e]);
    selected[e] = true;
    EXPECT_NEAR(gain, entropyRate(graph_, selected) - before, 1e-12);
    walk.add(graph_.edges[e]);
  }
  EXPECT_NEAR(walk.entropyRate(), entropyRate(graph_), 1e-12);
}

TEST_P(WalkLaws, monotoneAndSubmodular)
{
  std::mt19937 random(GetParam());
  for (int trial = 0; trial < 20; ++trial) {
    EdgeSubsetWalk small(graph_);
    EdgeSubsetWalk large(graph_);
    std::vector<bool> in_large(graph_.edges.size(), false);
    for (std::size_t e = 0; e < in_large.size(); ++e) {
      const unsigned draw = random() % 3;
      if (draw == 0)
        small.add(graph_.edges[e]);
      if (draw <= 1)
        large.add(graph_.edges[e]);
      in_large[e] = draw <= 1;
    }
    for (std::size_t e = 0; e < in_large.size(); ++e)
      if (!in_large[e]) {
        EXPECT_GE(large.gain(graph_.edges[e]), -1e-15);
        EXPECT_GE(small.gain(graph_.edges[e]), large.gain(graph_.edges[e]) - 1e-15);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Graphs, WalkLaws, testing::Range(0U, 40U));

TEST(RandomWalk, closedForms)
{
  EXPECT_NEAR(entropyRate(completeGraph(7, 0.3F)), std::log(6.0), 1e-12);
  WeightedGraph ring = randomGraph(9, 0.0, 1);
  for (WeightedEdge& edge : ring.edges)
    edge.weight = 5.0F;
  EXPECT_NEAR(entropyRate(ring), std::log(2.0), 1e-12);
  // A star: certain on the way back, log 5 from its centre, where half the time goes.
  WeightedGraph star;
  star.nodes = 6;
  for (std::uint32_t leaf = 1; leaf < 6; ++leaf)
    star.edges.push_back({0, leaf, 2.0F});
  EXPECT_NEAR(entropyRate(star), 0.5 * std::log(5.0), 1e-12);
  EXPECT_NEAR(stationaryDistribution(star)[0], 0.5, 1e-15);
}

TEST(RandomWalk, entropyRateIgnoresTheUnitOfTheWeights)
{
  WeightedGraph graph = randomGraph(14, 0.4, 3);
  const double rate = entropyRate(graph);
  for (WeightedEdge& edge : graph.edges)
    edge.weight *= 1024.0F;
  EXPECT_NEAR(entropyRate(graph), rate, 1e-13);
}

TEST(RandomWalk, latticeIsItsListOfEdges)
{
  const GridGeometry grid = turningLaser(24, 6);
  std::mt19937 random(5);
  const auto cloud = laserCloud(grid, [&](int, int) {
    return random() % 5 == 0 ? std::nan("")
                             : 2.0 + 1e-3 * static_cast<double>(random() % 1000);
  });
  GridGraph lattice;
  lattice.build(toGridPoints(cloud, grid), SensorNoise::hdl64());
  lattice.setWeights();
  const WeightedGraph all = toWeightedGraph(lattice);
  EXPECT_EQ(all.nodes, lattice.numCells());
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(24 * 6, 24 * 6);
  std::size_t strong = 0;
  for (int d = 0; d < 4; ++d)
    for (std::size_t i = 0; i < lattice.numCells(); ++i)
      if (lattice.target(d)[i] != GridGraph::kNone) {
        const auto from = static_cast<Eigen::Index>(i);
        const Eigen::Index to = lattice.target(d)[i];
        expected(from, to) = expected(to, from) =
            static_cast<double>(lattice.weight(d)[i]);
        strong += lattice.weight(d)[i] >= 0.2F ? 1 : 0;
      }
  EXPECT_EQ(denseWeights(all), expected);
  ASSERT_GT(strong, 0U);
  ASSERT_LT(strong, all.edges.size());
  EXPECT_EQ(toWeightedGraph(lattice, 0.2F).edges.size(), strong);
  const ConvexPair pair = convexPair(all);
  EXPECT_NEAR(pair.g - pair.h, entropyRate(all), 1e-12);
}

TEST(RandomWalk, withoutWeightThereIsNoEntropy)
{
  for (const WeightedGraph& graph :
       {WeightedGraph{0, {}}, WeightedGraph{3, {}}, WeightedGraph{2, {{0, 1, 0.0F}}}}) {
    EXPECT_EQ(entropyRate(graph), 0.0);
    EXPECT_EQ(convexPair(graph).g - convexPair(graph).h, 0.0);
    for (const double share : stationaryDistribution(graph))
      EXPECT_EQ(share, 0.0);
    for (const StepProbabilities& step : stepProbabilities(graph))
      EXPECT_EQ(step.forward + step.backward, 0.0);
    EdgeSubsetWalk walk(graph);
    for (const WeightedEdge& edge : graph.edges) {
      EXPECT_EQ(walk.gain(edge), 0.0);
      walk.add(edge);
    }
    EXPECT_EQ(walk.entropyRate(), 0.0);
  }
}

TEST(RandomWalk, refusesWhatIsNoGraph)
{
  const float infinite = std::numeric_limits<float>::infinity();
  for (const WeightedEdge& edge : {WeightedEdge{0, 2, 1.0F},
                                   WeightedEdge{1, 1, 1.0F},
                                   WeightedEdge{0, 1, -1.0F},
                                   WeightedEdge{0, 1, infinite},
                                   WeightedEdge{0, 1, std::nanf("")}}) {
    const WeightedGraph graph{2, {edge}};
    EXPECT_THROW(entropyRate(graph), std::invalid_argument);
    EXPECT_THROW(nodeWeights(graph), std::invalid_argument);
    EXPECT_THROW(convexPair(graph), std::invalid_argument);
    EXPECT_THROW(EdgeSubsetWalk{graph}, std::invalid_argument);
  }
  const WeightedGraph graph{2, {{0, 1, 1.0F}}};
  EXPECT_THROW(entropyRate(graph, {true, false}), std::invalid_argument);
}

} // namespace
