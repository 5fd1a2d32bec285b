// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/random_walk.h>

#include <Eigen/Core>

#include <numeric>
#include <random>

namespace pcl {
namespace nurbs {
namespace test {

/** Connected graph: a ring and random chords, weights over four orders of magnitude. */
inline WeightedGraph
randomGraph(std::uint32_t nodes, double chords, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> share;
  std::uniform_real_distribution<float> magnitude(-4.0F, 0.0F);
  WeightedGraph graph;
  graph.nodes = nodes;
  for (std::uint32_t a = 0; a < nodes; ++a)
    for (std::uint32_t b = a + 1; b < nodes; ++b) {
      const bool ring = b == a + 1 || (a == 0 && b + 1 == nodes);
      if (ring || share(random) < static_cast<float>(chords))
        graph.edges.push_back({a, b, std::pow(10.0F, magnitude(random))});
    }
  return graph;
}

/** Lattice with 4 or 8 neighbours whose weights are low across some lines, as borders
 * of surfaces, and random everywhere. */
inline WeightedGraph
randomLattice(std::uint32_t width,
              std::uint32_t height,
              unsigned seed,
              int connectivity = 8)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> share(0.3F, 1.0F);
  WeightedGraph graph;
  graph.nodes = static_cast<std::size_t>(width) * height;
  const auto region = [](std::uint32_t column, std::uint32_t row) {
    return column / 13 * 7 + row / 9;
  };
  for (std::uint32_t row = 0; row < height; ++row)
    for (std::uint32_t column = 0; column < width; ++column)
      for (const auto& [right, down] : {std::pair(1, 0), {0, 1}, {1, 1}, {-1, 1}}) {
        const std::uint32_t c = column + static_cast<std::uint32_t>(right);
        const std::uint32_t r = row + static_cast<std::uint32_t>(down);
        if (c >= width || r >= height || (connectivity == 4 && right != 0 && down != 0))
          continue;
        const float contrast = region(column, row) == region(c, r) ? 1.0F : 0.05F;
        graph.edges.push_back(
            {row * width + column, r * width + c, contrast * share(random)});
      }
  return graph;
}

/** Symmetric matrix W of a small graph. */
inline Eigen::MatrixXd
denseWeights(const WeightedGraph& graph)
{
  const auto n = static_cast<Eigen::Index>(graph.nodes);
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(n, n);
  for (const WeightedEdge& edge : graph.edges)
    w(edge.a, edge.b) = w(edge.b, edge.a) = edge.weight;
  return w;
}

/** Roots of the connected parts by a set of edges, by repeated relabelling. */
inline std::vector<std::uint32_t>
componentsOf(const WeightedGraph& graph, const std::vector<bool>& selected)
{
  std::vector<std::uint32_t> label(graph.nodes);
  std::iota(label.begin(), label.end(), 0U);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
      std::uint32_t& a = label[graph.edges[e].a];
      std::uint32_t& b = label[graph.edges[e].b];
      if (!selected[e] || a == b)
        continue;
      a = b = std::min(a, b);
      changed = true;
    }
  }
  return label;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
