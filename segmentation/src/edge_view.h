// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/random_walk.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace pcl {
namespace nurbs {

/** Numbered edges of a list or of a lattice, in the same order, without a copy. Edges
 * of no weight are not there; nothing else of them may be looked at. */
class EdgeView {
public:
  explicit EdgeView(const WeightedGraph& graph)
      : nodes_(graph.nodes), size_(graph.edges.size()), list_(graph.edges.data())
  {
  }

  /** Edges with a smaller weight than \a min_weight lose it. */
  EdgeView(const GridGraph& graph, float min_weight)
      : nodes_(graph.numCells()),
        size_(graph.numCells() * static_cast<std::size_t>(graph.numDirections())),
        shift_(graph.numDirections() == 2 ? 1U : 2U),
        min_weight_(min_weight)
  {
    for (int d = 0; d < graph.numDirections(); ++d) {
      target_[static_cast<std::size_t>(d)] = graph.target(d).data();
      weight_[static_cast<std::size_t>(d)] = graph.weight(d).data();
    }
  }

  std::size_t
  nodes() const
  {
    return nodes_;
  }

  std::size_t
  size() const
  {
    return size_;
  }

  WeightedEdge
  operator[](std::size_t number) const
  {
    if (list_ != nullptr)
      return list_[number];
    const std::size_t direction = directionOf(number);
    const std::size_t cell = number >> shift_;
    const float weight = weight_[direction][cell];
    return {static_cast<std::uint32_t>(cell),
            static_cast<std::uint32_t>(target_[direction][cell]),
            weight >= min_weight_ ? weight : 0.0F};
  }

  /** First node of an edge. */
  std::uint32_t
  source(std::uint32_t number) const
  {
    return list_ != nullptr ? list_[number].a : number >> shift_;
  }

private:
  std::size_t
  directionOf(std::size_t number) const
  {
    return number & ((std::size_t{1} << shift_) - 1);
  }

  std::size_t nodes_;
  std::size_t size_;
  const WeightedEdge* list_ = nullptr;
  unsigned int shift_ = 0;
  float min_weight_ = 0.0F;
  std::array<const std::int32_t*, 4> target_{};
  std::array<const float*, 4> weight_{};
};

} // namespace nurbs
} // namespace pcl
