// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/connected_groups.h>

#include "creases.h"
#include "disjoint_sets.h"
#include "label_order.h"

#include <algorithm>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

using Labels = std::vector<std::uint32_t>;

/** Cells that groups stay away from folds and jumps while they form. */
constexpr int kHeldBack = 3;

/** Label the groups of cells that \a member accepts and kept edges join, if they are
 * large enough; labels go on from \a last. */
template <typename Member>
std::uint32_t
labelGroups(const KeptEdges& edges,
            std::size_t min_size,
            const Member& member,
            std::uint32_t last,
            Labels& labels)
{
  const GridGraph& graph = edges.graph();
  const std::size_t cells = graph.numCells();
  DisjointSets sets(cells);
  bool any = false;
  for (std::size_t i = 0; i < cells; ++i) {
    if (!member(i))
      continue;
    any = true;
    for (int d = 0; d < graph.numDirections(); ++d)
      if (edges.keeps(d, i) && member(static_cast<std::size_t>(graph.target(d)[i])))
        sets.join(static_cast<std::uint32_t>(i),
                  static_cast<std::uint32_t>(graph.target(d)[i]));
  }
  if (!any)
    return last;
  std::vector<std::uint32_t> sizes(cells, 0);
  for (std::size_t i = 0; i < cells; ++i)
    if (member(i))
      ++sizes[sets.find(static_cast<std::uint32_t>(i))];
  Labels root_label(cells, 0);
  for (std::size_t i = 0; i < cells; ++i)
    if (sizes[i] >= min_size && sizes[i] > 0)
      root_label[i] = ++last;
  for (std::size_t i = 0; i < cells; ++i)
    if (member(i)) {
      const std::uint32_t label = root_label[sets.find(static_cast<std::uint32_t>(i))];
      if (label != 0)
        labels[i] = label;
    }
  return last;
}

/** Let the groups grow into the folds, all at the same speed. */
void
shareFolds(const KeptEdges& edges,
           const std::vector<std::uint8_t>& fold,
           Labels& labels)
{
  std::vector<std::size_t> front;
  const auto at_fold = [&](std::size_t cell) {
    bool found = false;
    edges.forEachNeighbour(
        cell, [&](std::size_t neighbour) { found = found || fold[neighbour] != 0; });
    return found;
  };
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] != 0 && at_fold(i))
      front.push_back(i);
  for (std::size_t next = 0; next < front.size(); ++next) {
    const std::size_t cell = front[next];
    edges.forEachNeighbour(cell, [&](std::size_t neighbour) {
      if (fold[neighbour] == 0 || labels[neighbour] != 0)
        return;
      labels[neighbour] = labels[cell];
      front.push_back(neighbour);
    });
  }
}

void
requireValid(const GridPoints& points,
             const GridGraph& graph,
             const ConnectedGroupsOptions& options)
{
  if (graph.numCells() != points.size())
    throw std::invalid_argument("connectedGroups: the graph is not of these points");
  if (!(options.min_weight > 0.0F) || !(options.jump_sigmas > 0.0F) ||
      !(options.crease_angle > 0.0F))
    throw std::invalid_argument("connectedGroups: thresholds must be positive");
  if (options.threads < 1)
    throw std::invalid_argument("connectedGroups: there must be a thread");
}

} // namespace

std::uint32_t
connectedGroups(const GridPoints& points,
                const GridGraph& graph,
                const SensorNoise& noise,
                const ConnectedGroupsOptions& options,
                Labels& labels)
{
  requireValid(points, graph, options);
  labels.assign(points.size(), 0);
  const KeptEdges edges(points, graph, noise, options);
  if (!options.split_creases) {
    const auto member = [&](std::size_t i) { return points.valid(i); };
    const std::uint32_t count = labelGroups(edges, options.min_size, member, 0, labels);
    orderBySize(count, labels);
    return count;
  }
  // Where a fold runs into a jump both grow faint: holding groups back from either
  // keeps them from leaking through.
  const std::vector<std::uint8_t> fold = nearBreaks(
      points.geometry, edges, findCreases(points, edges, noise, options), kHeldBack);
  const auto smooth = [&](std::size_t i) { return points.valid(i) && fold[i] == 0; };
  std::uint32_t count = labelGroups(edges, options.min_size, smooth, 0, labels);
  shareFolds(edges, fold, labels);
  // Small curved things may be all fold: they are groups of their own.
  const auto left = [&](std::size_t i) { return fold[i] != 0 && labels[i] == 0; };
  count = labelGroups(edges, options.min_size, left, count, labels);
  orderBySize(count, labels);
  return count;
}

} // namespace nurbs
} // namespace pcl
