// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/superpixels.h>

#include "disjoint_sets.h"
#include "forest_greedy.h"
#include "label_order.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

void
requireValid(const EdgeView& edges, const SuperpixelOptions& options)
{
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (edges.size() > kMost || edges.nodes() > kMost)
    throw std::invalid_argument("superpixels: the graph is too large");
  if (options.number == 0)
    throw std::invalid_argument("superpixels: there must be at least one group");
  if (!std::isfinite(options.balance) || options.balance < 0.0)
    throw std::invalid_argument("superpixels: the balance must not be negative");
}

/** Take out nodes whose connected part of the graph is too small. */
void
dropSmallParts(const EdgeView& edges, std::size_t min_part, std::vector<bool>& member)
{
  if (min_part <= 1)
    return;
  DisjointSets parts(edges.nodes());
  for (std::size_t number = 0; number < edges.size(); ++number) {
    const WeightedEdge edge = edges[number];
    if (edge.weight > 0.0F)
      parts.join(edge.a, edge.b);
  }
  std::vector<std::uint32_t> sizes(edges.nodes(), 0);
  for (std::uint32_t node = 0; node < edges.nodes(); ++node)
    ++sizes[parts.find(node)];
  for (std::uint32_t node = 0; node < edges.nodes(); ++node)
    if (sizes[parts.find(node)] < min_part)
      member[node] = false;
}

/** Label the nodes of \a member by their group and find the balance term. */
void
labelGroups(const ForestGreedy& greedy,
            const std::vector<bool>& member,
            Superpixels& result)
{
  std::vector<std::uint32_t>& labels = result.labels;
  labels.assign(member.size(), 0);
  std::vector<std::uint32_t> label_of_group(member.size(), 0);
  std::vector<std::uint32_t> sizes;
  for (std::uint32_t node = 0; node < member.size(); ++node) {
    if (!member[node])
      continue;
    std::uint32_t& label = label_of_group[greedy.groupOf(node)];
    if (label == 0) {
      label = ++result.count;
      sizes.push_back(0);
    }
    labels[node] = label;
    ++sizes[label - 1];
  }
  double nodes = 0.0;
  for (const std::uint32_t size : sizes) {
    nodes += size;
    result.balance -= xLogX(size);
  }
  if (nodes > 0.0)
    result.balance = result.balance / nodes + std::log(nodes) - result.count;
  orderBySize(result.count, labels);
}

Superpixels
group(const EdgeView& edges, const SuperpixelOptions& options, std::vector<bool> member)
{
  requireValid(edges, options);
  dropSmallParts(edges, options.min_part, member);
  ForestGreedy greedy(edges, member);
  Superpixels result;
  if (greedy.numMembers() == 0) {
    result.labels.assign(edges.nodes(), 0);
    return result;
  }
  // Largest gain in balance: two single nodes become one group.
  const double first_balance =
      1.0 - xLogX(2.0) / static_cast<double>(greedy.numMembers());
  if (first_balance > 0.0)
    result.lambda = options.balance * static_cast<double>(options.number) *
                    greedy.firstGain() / first_balance;
  greedy.run(options.number, result.lambda);
  result.edges = greedy.selected();
  result.entropy_rate = greedy.entropyRate();
  labelGroups(greedy, member, result);
  return result;
}

} // namespace

Superpixels
entropyRateSuperpixels(const WeightedGraph& graph, const SuperpixelOptions& options)
{
  requireValidGraph(graph);
  return group(EdgeView(graph), options, std::vector<bool>(graph.nodes, true));
}

Superpixels
gridSuperpixels(const GridPoints& points,
                const GridGraph& graph,
                float min_weight,
                const SuperpixelOptions& options)
{
  if (graph.numCells() != points.size())
    throw std::invalid_argument("superpixels: the graph is not of these points");
  requireValidWeights(graph);
  std::vector<bool> valid(points.size());
  for (std::size_t cell = 0; cell < points.size(); ++cell)
    valid[cell] = points.valid(cell);
  return group(EdgeView(graph, min_weight), options, std::move(valid));
}

} // namespace nurbs
} // namespace pcl
