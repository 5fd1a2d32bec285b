// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The greedy algorithms that superpixels are compared with.

#pragma once

#include "random_graphs.h"

#include <pcl/segmentation/superpixels.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

/** B by its definition. */
inline double
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

inline double
objectiveOf(const WeightedGraph& graph,
            const std::vector<bool>& selected,
            double lambda)
{
  return entropyRate(graph, selected) +
         lambda * balanceOf(componentsOf(graph, selected));
}

/** lambda by its definition (Liu et al., section 4). */
inline double
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
inline std::vector<std::uint32_t>
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

/** Greedy selection that finds every gain by the closed forms at every step: equal
 * gains come out equal, of which the first edge is taken. */
inline std::vector<std::uint32_t>
closedFormGreedy(const WeightedGraph& graph, std::size_t number, double lambda)
{
  std::vector<SelfLoop> loops(graph.nodes);
  double total = 0.0;
  for (const WeightedEdge& edge : graph.edges)
    for (const std::uint32_t end : {edge.a, edge.b}) {
      loops[end].weight += edge.weight;
      total += edge.weight;
    }
  for (SelfLoop& loop : loops)
    loop.term = xLogX(loop.weight);
  const double scale = lambda * total / static_cast<double>(graph.nodes);
  std::vector<std::uint32_t> group(graph.nodes);
  std::iota(group.begin(), group.end(), 0U);
  std::vector<double> size(graph.nodes, 1.0);
  std::vector<std::uint32_t> order;
  while (graph.nodes - order.size() > number) {
    double most = -std::numeric_limits<double>::infinity();
    std::uint32_t best = 0;
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
      const auto [a, b, weight] = graph.edges[e];
      const double m = size[group[a]];
      const double n = size[group[b]];
      const double gain = scaledEdgeGain(loops[a], loops[b], weight) +
                          scale * (xLogX(m) + xLogX(n) - xLogX(m + n) + xLogX(2.0));
      if (group[a] != group[b] && gain > most) {
        most = gain;
        best = e;
      }
    }
    if (!std::isfinite(most))
      break;
    const auto [a, b, weight] = graph.edges[best];
    loops[a].shorten(weight);
    loops[b].shorten(weight);
    size[group[a]] += size[group[b]];
    std::replace(
        group.begin(), group.end(), std::uint32_t{group[b]}, std::uint32_t{group[a]});
    order.push_back(best);
  }
  return order;
}

inline std::vector<bool>
flags(const WeightedGraph& graph, const std::vector<std::uint32_t>& edges)
{
  std::vector<bool> selected(graph.edges.size(), false);
  for (const std::uint32_t edge : edges)
    selected[edge] = true;
  return selected;
}

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

} // namespace test
} // namespace nurbs
} // namespace pcl
