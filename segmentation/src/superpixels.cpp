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
requireValid(const WeightedGraph& graph, const SuperpixelOptions& options)
{
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (graph.edges.size() > kMost || graph.nodes > kMost)
    throw std::invalid_argument("superpixels: the graph is too large");
  requireValidGraph(graph);
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
    if (edge.weight > 0.0F)
      parts.join(edge.a, edge.b);
  std::vector<std::uint32_t> sizes(graph.nodes, 0);
  for (std::uint32_t node = 0; node < graph.nodes; ++node)
    ++sizes[parts.find(node)];
  for (std::uint32_t node = 0; node < graph.nodes; ++node)
    large[node] = sizes[parts.find(node)] >= min_part;
  return large;
}

/** Numbers of the edges between nodes of \a member. */
std::vector<std::uint32_t>
edgesAmong(const std::vector<bool>& member, const WeightedGraph& graph)
{
  std::vector<std::uint32_t> edges;
  edges.reserve(graph.edges.size());
  for (std::uint32_t edge = 0; edge < graph.edges.size(); ++edge)
    if (graph.edges[edge].weight > 0.0F && member[graph.edges[edge].a])
      edges.push_back(edge);
  return edges;
}

/** Renumber the nodes of a graph of cells so that empty cells are none. */
void
dropEmptyCells(const GridPoints& points, WeightedGraph& graph)
{
  std::vector<std::uint32_t> node(points.size(), 0);
  std::uint32_t next = 0;
  for (std::size_t cell = 0; cell < node.size(); ++cell)
    if (points.valid(cell))
      node[cell] = next++;
  for (WeightedEdge& edge : graph.edges) {
    edge.a = node[edge.a];
    edge.b = node[edge.b];
  }
  graph.nodes = next;
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

} // namespace

Superpixels
entropyRateSuperpixels(const WeightedGraph& graph, const SuperpixelOptions& options)
{
  requireValid(graph, options);
  const std::vector<bool> member = largeParts(graph, options.min_part);
  std::size_t nodes = 0;
  for (const bool taken : member)
    nodes += taken ? 1 : 0;
  ForestGreedy greedy(graph, edgesAmong(member, graph), nodes);
  Superpixels result;
  // Largest gain in balance: two single nodes become one group.
  const double first_balance = 1.0 - xLogX(2.0) / static_cast<double>(nodes);
  if (nodes > 1)
    result.lambda = options.balance * static_cast<double>(options.number) *
                    greedy.firstGain() / first_balance;
  greedy.run(options.number, result.lambda);
  result.edges = greedy.selected();
  result.entropy_rate = greedy.entropyRate();
  labelGroups(greedy, member, result);
  return result;
}

Superpixels
gridSuperpixels(const GridPoints& points,
                const GridGraph& graph,
                float min_weight,
                const SuperpixelOptions& options)
{
  if (graph.numCells() != points.size())
    throw std::invalid_argument("superpixels: the graph is not of these points");
  WeightedGraph list = toWeightedGraph(graph, min_weight);
  dropEmptyCells(points, list);
  Superpixels result = entropyRateSuperpixels(list, options);
  const std::vector<std::uint32_t> node_labels = std::move(result.labels);
  result.labels.assign(points.size(), 0);
  std::size_t node = 0;
  for (std::size_t cell = 0; cell < points.size(); ++cell)
    if (points.valid(cell))
      result.labels[cell] = node_labels[node++];
  return result;
}

} // namespace nurbs
} // namespace pcl
