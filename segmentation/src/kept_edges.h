// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/connected_groups.h>

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** Edges of a graph that survive: for each cell the directions of those that begin
 * there and of those that end there, as bits. The graph must outlive this. */
class KeptEdges {
public:
  /** Keep what is neither of low weight nor over a depth jump.
   * \param[in] direction_noise deviation of each cell's depth that errors of its
   * direction cause, if known */
  KeptEdges(const GridPoints& points,
            const GridGraph& graph,
            const SensorNoise& noise,
            const ConnectedGroupsOptions& options,
            const std::vector<float>& direction_noise = {});

  const GridGraph&
  graph() const
  {
    return graph_;
  }

  bool
  keeps(int direction, std::size_t cell) const
  {
    return isSet(begin_[cell], direction);
  }

  /** Whether an edge that begins at this cell was removed. */
  bool
  isCut(std::size_t cell) const
  {
    for (int d = 0; d < graph_.numDirections(); ++d)
      if (graph_.target(d)[cell] != GridGraph::kNone && !keeps(d, cell))
        return true;
    return false;
  }

  /** Call visit(neighbour, weight) for every cell a kept edge joins to this one. */
  template <typename Visit>
  void
  forEachEdge(std::size_t cell, const Visit& visit) const
  {
    const unsigned int begin = begin_[cell];
    const unsigned int end = end_[cell];
    for (int d = 0; (begin | end) >> static_cast<unsigned int>(d) != 0; ++d) {
      const Lines& lines = lines_[static_cast<std::size_t>(d)];
      if (isSet(begin, d))
        visit(static_cast<std::size_t>(lines.target[cell]), lines.weight[cell]);
      if (isSet(end, d)) {
        const auto from = static_cast<std::size_t>(lines.source[cell]);
        visit(from, lines.weight[from]);
      }
    }
  }

  /** Call visit(neighbour) for every cell a kept edge joins to this one. */
  template <typename Visit>
  void
  forEachNeighbour(std::size_t cell, const Visit& visit) const
  {
    forEachEdge(cell, [&](std::size_t neighbour, float) { visit(neighbour); });
  }

  /** Call visit(cells) for every longest chain of kept edges along a direction. */
  template <typename Visit>
  void
  forEachRun(int direction, const Visit& visit) const
  {
    std::vector<std::uint8_t> seen(graph_.numCells(), 0);
    std::vector<std::size_t> run;
    const auto walk = [&](std::size_t cell) {
      run.clear();
      for (;;) {
        seen[cell] = 1;
        run.push_back(cell);
        if (!keeps(direction, cell))
          break;
        cell = static_cast<std::size_t>(graph_.target(direction)[cell]);
        if (seen[cell] != 0)
          break;
      }
      visit(run);
    };
    for (std::size_t cell = 0; cell < seen.size(); ++cell)
      if (!isSet(end_[cell], direction))
        walk(cell);
    // What is left closes on itself over the seam of a grid that wraps.
    for (std::size_t cell = 0; cell < seen.size(); ++cell)
      if (seen[cell] == 0)
        walk(cell);
  }

private:
  /** Of the graph, in one direction. */
  struct Lines {
    const std::int32_t* target;
    const std::int32_t* source;
    const float* weight;
  };

  static bool
  isSet(unsigned int bits, int direction)
  {
    return (bits >> static_cast<unsigned int>(direction) & 1U) != 0;
  }

  template <typename Jumps>
  void
  markBegins(std::size_t direction,
             Jumps jumps,
             float min_weight,
             std::size_t first,
             std::size_t last);

  void
  markEnds(std::size_t direction, std::size_t first, std::size_t last);

  const GridGraph& graph_;
  std::vector<Lines> lines_;
  std::vector<std::uint8_t> begin_; // bit d: the edge in direction d from this cell
  std::vector<std::uint8_t> end_;   // bit d: the edge in direction d to this cell
};

} // namespace nurbs
} // namespace pcl
