// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/segment_borders.h>

#include "grid_steps.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace pcl {
namespace nurbs {
namespace {

/** Pieces of border across the edges of one direction. */
void
collectPieces(const GridPoints& points,
              const GridGraph& graph,
              const std::vector<std::uint32_t>& labels,
              float min_weight,
              int direction,
              std::vector<SegmentBorder>& pieces)
{
  const int across =
      direction == GridGraph::kRight ? GridGraph::kDown : GridGraph::kRight;
  const GridSpacing spacing(points.geometry, across);
  const bool lattice = points.geometry.projection == GridProjection::lattice;
  const std::vector<std::int32_t>& target = graph.target(direction);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (target[i] == GridGraph::kNone || labels[i] == 0)
      continue;
    const auto j = static_cast<std::size_t>(target[i]);
    const auto [first, second] = std::minmax(labels[i], labels[j]);
    if (first == 0 || first == second || graph.weight(direction)[i] < min_weight)
      continue;
    const float depth = std::min(points.depth[i], points.depth[j]);
    pieces.push_back(
        {first, second, 1, lattice ? 1.0 : static_cast<double>(spacing(depth))});
  }
}

} // namespace

std::vector<SegmentBorder>
segmentBorders(const GridPoints& points,
               const GridGraph& graph,
               const std::vector<std::uint32_t>& labels,
               float min_weight)
{
  if (graph.numCells() != points.size() || labels.size() != points.size())
    throw std::invalid_argument(
        "segmentBorders: graph and labels are not of these points");
  std::vector<SegmentBorder> borders;
  for (const int direction : {GridGraph::kRight, GridGraph::kDown})
    collectPieces(points, graph, labels, min_weight, direction, borders);
  const auto pair = [](const SegmentBorder& border) {
    return std::tie(border.first, border.second);
  };
  std::stable_sort(borders.begin(),
                   borders.end(),
                   [&](const SegmentBorder& p, const SegmentBorder& q) {
                     return pair(p) < pair(q);
                   });
  std::size_t last = 0;
  for (std::size_t k = 1; k < borders.size(); ++k)
    if (pair(borders[k]) == pair(borders[last])) {
      borders[last].cells += borders[k].cells;
      borders[last].length += borders[k].length;
    }
    else
      borders[++last] = borders[k];
  borders.resize(borders.empty() ? 0 : last + 1);
  return borders;
}

} // namespace nurbs
} // namespace pcl
