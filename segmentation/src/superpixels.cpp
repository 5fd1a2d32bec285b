// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/superpixels.h>

#include "forest_greedy.h"
#include "label_order.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

void
requireValid(const SuperpixelOptions& options)
{
  if (options.number == 0)
    throw std::invalid_argument("superpixels: there must be at least one group");
  if (!std::isfinite(options.balance) || options.balance < 0.0)
    throw std::invalid_argument("superpixels: the balance must not be negative");
}

/** Nodes whose connected part of the graph is large enough. */
std::vector<bool>
largeParts(const WeightedGraph& graph, std::size_t min_part)
{
  std::vector<bool> large(graph.nodes, true);
  if (min_part <= 1)
    return large;
  DisjointSets parts(graph.nodes);
  for (const WeightedEdge& edge : graph.edges)
    parts.join(edge.a, edge.b);
  std::vector<std::uint32_t> sizes(graph.nodes, 0);
  for (std::uint32_t node = 0; node < graph.nodes; ++node)
    ++sizes[parts.find(node)];
  for (std::uint32_t node = 0; node < graph.nodes; ++node)
    large[node] = sizes[parts.find(node)] >= min_part;
  return large;
}

/** Label the nodes of \a member by their group and find the balance term. */
void
labelGroups(DisjointSets& sets, const std::vector<bool>& member, Superpixels& result)
{
  std::vector<std::uint32_t>& labels = result.labels;
  labels.assign(member.size(), 0);
  std::vector<std::uint32_t> sizes;
  for (std::uint32_t node = 0; node < member.size(); ++node) {
    if (!member[node])
      continue;
    const std::uint32_t root = sets.find(node); // the first node of its group
    if (root == node) {
      labels[node] = ++result.count;
      sizes.push_back(0);
    }
    labels[node] = labels[root];
    ++sizes[labels[node] - 1];
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

} // namespace

Superpixels
entropyRateSuperpixels(const WeightedGraph& graph, const SuperpixelOptions& options)
{
  requireValid(options);
  const std::vector<bool> member = largeParts(graph, options.min_part);
  std::size_t nodes = 0;
  for (const bool taken : member)
    nodes += taken ? 1 : 0;
  std::vector<std::uint32_t> candidates;
  candidates.reserve(graph.edges.size());
  for (std::uint32_t edge = 0; edge < graph.edges.size(); ++edge)
    if (member[graph.edges[edge].a])
      candidates.push_back(edge);
  ForestGreedy greedy(graph, std::move(candidates), nodes);
  Superpixels result;
  // Largest gain in balance: two single nodes become one group.
  const double first_balance = 1.0 - xLogX(2.0) / static_cast<double>(nodes);
  if (nodes > 1)
    result.lambda = options.balance * static_cast<double>(options.number) *
                    greedy.firstGain() / first_balance;
  greedy.run(options.number, result.lambda);
  result.edges = greedy.selected();
  result.entropy_rate = greedy.entropyRate();
  labelGroups(greedy.sets(), member, result);
  return result;
}

} // namespace nurbs
} // namespace pcl
