// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Superpixels against the greedy algorithm that looks at every edge every time, on
// larger graphs against a plain lazy heap; what holds for any graph.

#include <pcl/segmentation/superpixels.h>

#include "random_graphs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <stdexcept>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** B by its definition. */
double
balanceOf(const std::vector<std::uint32_t>& group)
{
  std::map<std::uint32_t, double> sizes;
  for (const std::uint32_t name : group)
    sizes[name] += 1.0 / static_cast<double>(group.size());
  double entropy = 0.0;
  for (const auto& [name, share] : sizes)
    entropy -= share * std::log(share);
  return entropy - static_cast<double>(sizes.size());
}

double
objectiveOf(const WeightedGraph& graph,
            const std::vector<bool>& selected,
            double lambda)
{
  return entropyRate(graph, selected) +
         lambda * balanceOf(componentsOf(graph, selected));
}

/** lambda by its definition (Liu et al., section 4). */
double
lambdaOf(const WeightedGraph& graph, const SuperpixelOptions& options)
{
  std::vector<bool> selected(graph.edges.size(), false);
  const double first_balance = balanceOf(componentsOf(graph, selected));
  double rate = 0.0;
  double balance = 0.0;
  for (std::size_t e = 0; e < selected.size(); ++e) {
    selected[e] = true;
    rate = std::max(rate, entropyRate(graph, selected));
    balance =
        std::max(balance, balanceOf(componentsOf(graph, selected)) - first_balance);
    selected[e] = false;
  }
  return options.balance * static_cast<double>(options.number) * rate / balance;
}

/** Greedy selection that finds every gain by recomputation at every step. */
std::vector<std::uint32_t>
naiveGreedy(const WeightedGraph& graph, std::size_t number, double lambda)
{
  std::vector<bool> selected(graph.edges.size(), false);
  std::vector<std::uint32_t> order;
  for (std::size_t groups = graph.nodes; groups > number; --groups) {
    const std::vector<std::uint32_t> group = componentsOf(graph, selected);
    double most = -std::numeric_limits<double>::infinity();
    std::uint32_t best = 0;
    for (std::uint32_t e = 0; e < selected.size(); ++e) {
      if (group[graph.edges[e].a] == group[graph.edges[e].b])
        continue;
      selected[e] = true;
      const double objective = objectiveOf(graph, selected, lambda);
      selected[e] = false;
      if (objective > most) {
        most = objective;
        best = e;
      }
    }
    if (!std::isfinite(most))
      break;
    selected[best] = true;
    order.push_back(best);
  }
  return order;
}

std::vector<bool>
flags(const WeightedGraph& graph, const std::vector<std::uint32_t>& edges)
{
  std::vector<bool> selected(graph.edges.size(), false);
  for (const std::uint32_t edge : edges)
    selected[edge] = true;
  return selected;
}

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

/** Lazy greedy with a heap over all edges, as in the paper. */
class LazyHeap {
public:
  LazyHeap(const WeightedGraph& graph, double lambda)
      : graph_(graph), walk_(graph), group_(graph.nodes), size_(graph.nodes, 1.0)
  {
    std::iota(group_.begin(), group_.end(), 0U);
    scale_ = lambda;
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e)
      queue_.push({gain(e), e});
  }

  std::vector<std::uint32_t>
  run(std::size_t number)
  {
    std::vector<std::uint32_t> order;
    while (graph_.nodes - order.size() > number && !queue_.empty()) {
      const std::uint32_t e = queue_.top().second;
      queue_.pop();
      if (find(graph_.edges[e].a) == find(graph_.edges[e].b))
        continue;
      const double now = gain(e);
      if (!queue_.empty() && now < queue_.top().first) {
        queue_.push({now, e});
        continue;
      }
      select(e);
      order.push_back(e);
    }
    return order;
  }

private:
  std::uint32_t
  find(std::uint32_t node) const
  {
    while (group_[node] != node)
      node = group_[node];
    return node;
  }

  double
  gain(std::uint32_t e) const
  {
    const double all = static_cast<double>(graph_.nodes);
    const auto entropy = [&](double size) {
      return -size / all * std::log(size / all);
    };
    const double a = size_[find(graph_.edges[e].a)];
    const double b = size_[find(graph_.edges[e].b)];
    return walk_.gain(graph_.edges[e]) +
           scale_ * (entropy(a + b) - entropy(a) - entropy(b) + 1.0);
  }

  void
  select(std::uint32_t e)
  {
    std::uint32_t a = find(graph_.edges[e].a);
    std::uint32_t b = find(graph_.edges[e].b);
    if (size_[a] < size_[b])
      std::swap(a, b);
    walk_.add(graph_.edges[e]);
    group_[b] = a;
    size_[a] += size_[b];
  }

  const WeightedGraph& graph_;
  EdgeSubsetWalk walk_;
  std::vector<std::uint32_t> group_;
  std::vector<double> size_;
  double scale_ = 0.0;
  std::priority_queue<std::pair<double, std::uint32_t>> queue_;
};

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
  for (const double balance : {0.0, 0.02, 0.5}) {
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
