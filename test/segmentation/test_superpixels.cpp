// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Superpixels against the greedy algorithm that looks at every edge every time, on
// larger graphs against a plain lazy heap; what holds for any graph.

#include <pcl/segmentation/superpixels.h>

#include "greedy_oracles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

class EqualsNaive
    : public testing::TestWithParam<std::tuple<unsigned, std::size_t, double>> {};

TEST_P(EqualsNaive, edgeForEdge)
{
  const auto [seed, number, balance] = GetParam();
  const WeightedGraph graph =
      seed % 2 == 0 ? randomGraph(24, 0.2, seed) : randomLattice(6, 5, seed);
  const SuperpixelOptions options{number, balance, 1};
  const Superpixels result = entropyRateSuperpixels(graph, options);
  const double lambda = lambdaOf(graph, options);
  EXPECT_NEAR(result.lambda, lambda, 1e-9 * lambda);
  EXPECT_EQ(result.edges, naiveGreedy(graph, number, lambda));
  const std::vector<bool> selected = flags(graph, result.edges);
  EXPECT_NEAR(result.entropy_rate, entropyRate(graph, selected), 1e-12);
  EXPECT_NEAR(result.balance, balanceOf(componentsOf(graph, selected)), 1e-12);
  EXPECT_NEAR(result.objective(), objectiveOf(graph, selected, lambda), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Graphs,
                         EqualsNaive,
                         testing::Combine(testing::Range(0U, 10U),
                                          testing::Values(1U, 2U, 5U, 12U),
                                          testing::Values(0.0, 0.5, 5.0)));

/** Weights are few powers of two, so that ties abound and sums are exact. */
WeightedGraph
tiedLattice(std::uint32_t width, std::uint32_t height, unsigned seed, int connectivity)
{
  WeightedGraph graph = randomLattice(width, height, seed, connectivity);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> halvings(0, static_cast<int>(seed % 3));
  for (WeightedEdge& edge : graph.edges)
    edge.weight = std::ldexp(1.0F, -halvings(random));
  return graph;
}

class TiesAreBroken
    : public testing::TestWithParam<std::tuple<unsigned, int, std::size_t, double>> {};

TEST_P(TiesAreBroken, byTheFirstEdge)
{
  const auto [seed, connectivity, number, balance] = GetParam();
  const WeightedGraph graph = tiedLattice(17, 12, seed, connectivity);
  const Superpixels result = entropyRateSuperpixels(graph, {number, balance, 1});
  EXPECT_EQ(result.edges, closedFormGreedy(graph, number, result.lambda));
}

TEST(Superpixels, latticeOfEitherKindEqualsTheClosedFormsEdgeForEdge)
{
  for (const int connectivity : {4, 8})
    for (const std::size_t number : {1, 50}) {
      const WeightedGraph graph = randomLattice(50, 36, 5, connectivity);
      const Superpixels result = entropyRateSuperpixels(graph, {number, 0.5, 1});
      EXPECT_EQ(result.edges, closedFormGreedy(graph, number, result.lambda));
    }
}

TEST(Superpixels, largeLatticeWithFourNeighboursReachesTheObjectiveOfALazyHeap)
{
  // Of the last two edges of a node both gain the same there, so that rounding decides.
  const WeightedGraph graph = randomLattice(240, 160, 7, 4);
  for (const std::size_t number : {1, 40, 700}) {
    const Superpixels result = entropyRateSuperpixels(graph, {number, 0.5, 1});
    const auto expected = LazyHeap(graph, result.lambda).run(number);
    EXPECT_NEAR(result.objective(),
                objectiveOf(graph, flags(graph, expected), result.lambda),
                1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Lattices,
                         TiesAreBroken,
                         testing::Combine(testing::Range(0U, 6U),
                                          testing::Values(4, 8),
                                          testing::Values(1U, 9U, 60U),
                                          testing::Values(0.0, 0.5, 5.0)));

TEST(Superpixels, largeLatticeEqualsALazyHeap)
{
  for (const std::size_t number : {1, 40, 700}) {
    const WeightedGraph graph = randomLattice(240, 160, 7);
    const Superpixels result = entropyRateSuperpixels(graph, {number, 0.5, 1});
    EXPECT_EQ(result.count, number);
    const auto expected = LazyHeap(graph, result.lambda).run(number);
    EXPECT_NEAR(result.objective(),
                objectiveOf(graph, flags(graph, expected), result.lambda),
                1e-9);
    EXPECT_EQ(std::set<std::uint32_t>(result.edges.begin(), result.edges.end()),
              std::set<std::uint32_t>(expected.begin(), expected.end()));
  }
}

/** Labels are those of the parts that the edges make, and ordered by size. */
void
expectConsistent(const WeightedGraph& graph, const Superpixels& result)
{
  const std::vector<std::uint32_t> group =
      componentsOf(graph, flags(graph, result.edges));
  std::map<std::uint32_t, std::uint32_t> label_of_group;
  std::vector<std::size_t> sizes(result.count, 0);
  for (std::size_t node = 0; node < graph.nodes; ++node) {
    const std::uint32_t label = result.labels[node];
    ASSERT_LE(label, result.count);
    EXPECT_EQ(label_of_group.emplace(group[node], label).first->second, label);
    if (label != 0)
      ++sizes[label - 1];
  }
  EXPECT_TRUE(std::is_sorted(sizes.rbegin(), sizes.rend()));
  EXPECT_TRUE(result.count == 0 || sizes.back() > 0);
  const auto members = static_cast<std::size_t>(
      std::count_if(result.labels.begin(), result.labels.end(), [](std::uint32_t l) {
        return l != 0;
      }));
  EXPECT_EQ(result.edges.size() + result.count, members); // a forest
}

TEST(Superpixels, equalWeightsGiveConnectedGroupsOfLikeSize)
{
  WeightedGraph graph = randomLattice(60, 40, 1);
  for (WeightedEdge& edge : graph.edges)
    edge.weight = 0.5F;
  const Superpixels result = entropyRateSuperpixels(graph, {24, 0.5, 1});
  EXPECT_EQ(result.count, 24U);
  expectConsistent(graph, result);
  std::vector<int> sizes(25, 0);
  for (const std::uint32_t label : result.labels)
    ++sizes[label];
  EXPECT_LT(sizes[1], 250); // 100 on average
}

TEST(Superpixels, balanceEvensSizes)
{
  WeightedGraph graph = randomLattice(80, 60, 3);
  for (WeightedEdge& edge : graph.edges) // without borders that would decide alone
    edge.weight = std::max(edge.weight, 0.3F);
  double last = -1.0;
  for (const double balance : {0.0, 0.5, 5.0}) {
    const Superpixels result = entropyRateSuperpixels(graph, {50, balance, 1});
    EXPECT_EQ(result.count, 50U);
    expectConsistent(graph, result);
    const double evenness = result.balance + 50.0; // entropy of the sizes
    EXPECT_GT(evenness, last);
    last = evenness;
  }
  EXPECT_GT(last, 0.95 * std::log(50.0));
}

TEST(Superpixels, groupsKeepToStrongEdges)
{
  const WeightedGraph graph = randomLattice(52, 36, 3); // 4 x 4 regions
  const Superpixels result = entropyRateSuperpixels(graph, {16, 0.5, 1});
  std::size_t weak = 0;
  for (const std::uint32_t edge : result.edges)
    weak += graph.edges[edge].weight < 0.1F ? 1 : 0;
  EXPECT_EQ(weak, 0U);
}

/** Two rings without an edge between, a pair, and a node of its own. */
WeightedGraph
partedGraph()
{
  WeightedGraph graph = randomGraph(30, 0.1, 2);
  const WeightedGraph second = randomGraph(20, 0.1, 3);
  for (const WeightedEdge& edge : second.edges)
    graph.edges.push_back({edge.a + 30, edge.b + 30, edge.weight});
  graph.edges.push_back({50, 51, 0.5F});
  graph.nodes = 53;
  return graph;
}

TEST(Superpixels, partsStayApart)
{
  const WeightedGraph graph = partedGraph();
  const Superpixels all = entropyRateSuperpixels(graph, {1, 0.5, 1});
  EXPECT_EQ(all.count, 4U);
  expectConsistent(graph, all);
  const Superpixels large = entropyRateSuperpixels(graph, {5, 0.5, 20});
  EXPECT_EQ(large.count, 5U);
  expectConsistent(graph, large);
  EXPECT_EQ(std::count(large.labels.begin(), large.labels.end(), 0U), 3);
  EXPECT_EQ(entropyRateSuperpixels(graph, {5, 0.5, 31}).count, 0U);
}

TEST(Superpixels, degenerateGraphs)
{
  EXPECT_EQ(entropyRateSuperpixels({0, {}}, {3, 0.5, 1}).count, 0U);
  const Superpixels lonely = entropyRateSuperpixels({4, {}}, {2, 0.5, 1});
  EXPECT_EQ(lonely.count, 4U);
  EXPECT_EQ(lonely.entropy_rate, 0.0);
  EXPECT_TRUE(std::isfinite(lonely.objective()));
  const Superpixels weightless =
      entropyRateSuperpixels({2, {{0, 1, 0.0F}}}, {1, 0.5, 1});
  EXPECT_EQ(weightless.count, 2U);
  const Superpixels pair = entropyRateSuperpixels({2, {{0, 1, 1e-30F}}}, {1, 0.5, 1});
  EXPECT_EQ(pair.count, 1U);
  EXPECT_NEAR(pair.entropy_rate, 0.0, 1e-12); // nobody can do but step across
  const WeightedGraph graph = randomGraph(20, 0.2, 1);
  EXPECT_EQ(entropyRateSuperpixels(graph, {50, 0.5, 1}).count, 20U);
}

TEST(Superpixels, hugeRangeOfWeights)
{
  WeightedGraph graph = randomLattice(40, 30, 2);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> magnitude(-37.0F, 37.0F);
  for (WeightedEdge& edge : graph.edges)
    edge.weight = std::pow(10.0F, magnitude(random));
  const Superpixels result = entropyRateSuperpixels(graph, {10, 0.5, 1});
  EXPECT_EQ(result.count, 10U);
  EXPECT_TRUE(std::isfinite(result.objective()));
  expectConsistent(graph, result);
}

TEST(Superpixels, refusesWhatMakesNoSense)
{
  const double nan = std::nan("");
  const WeightedGraph graph = randomGraph(6, 0.5, 1);
  EXPECT_THROW(entropyRateSuperpixels(graph, {0, 0.5, 1}), std::invalid_argument);
  EXPECT_THROW(entropyRateSuperpixels(graph, {2, -0.5, 1}), std::invalid_argument);
  EXPECT_THROW(entropyRateSuperpixels(graph, {2, nan, 1}), std::invalid_argument);
  const float infinite = std::numeric_limits<float>::infinity();
  for (const WeightedEdge& edge : {WeightedEdge{0, 7, 1.0F},
                                   WeightedEdge{0, 1, infinite},
                                   WeightedEdge{0, 1, -1.0F}})
    EXPECT_THROW(entropyRateSuperpixels({2, {edge}}, {1, 0.5, 2}),
                 std::invalid_argument);
}

} // namespace
