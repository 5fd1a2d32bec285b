// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "surface_criterion.h"
#include "surface_nodes.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace pcl {
namespace nurbs {

/** A piece of the border between two sets of cells, in one block. */
struct BorderPiece {
  std::size_t cells = 0;
  std::size_t middle = 0; /**< one of its cells */
};

/** Two sets of cells, a < b, and the block their border passes. */
struct BorderKey {
  std::uint32_t a;
  std::uint32_t b;
  std::size_t block;

  bool
  operator<(const BorderKey& other) const
  {
    return std::tie(a, b, block) < std::tie(other.a, other.b, other.block);
  }
};

/** Pieces of borders, in the order in which their cells are added. */
class BorderPieces {
public:
  BorderPieces(const GridGeometry& grid, BlockSize size)
      : width_(static_cast<std::size_t>(grid.width)), size_(size)
  {
  }

  void
  add(std::uint32_t p, std::uint32_t q, std::size_t cell);

  std::vector<std::pair<BorderKey, BorderPiece>>
  list() const
  {
    return {pieces_.begin(), pieces_.end()};
  }

private:
  std::size_t width_;
  BlockSize size_;
  std::map<BorderKey, BorderPiece> pieces_;
};

/** Pieces of border over kept edges between numbers below \a facets. O(cells). */
BorderPieces
keptBorders(const GridGeometry& grid,
            const KeptEdges& edges,
            const std::vector<std::uint32_t>& cell_facet,
            std::uint32_t facets,
            BlockSize size);

/** Two surfaces at a place of their border, as the points near by have them. */
struct BorderFit {
  double step; /**< between them (standard deviations) */
  /** Whether one curved surface explains both sides better than two planes. */
  bool bends;
  std::array<Eigen::Vector3d, 2> normal; /**< unit, of either side at the border */
  std::array<Eigen::Vector3d, 2> middle; /**< of the points of either side */
};

/** Fits surfaces to the points of two sets of cells near a place. */
class BorderFitter {
public:
  /** \param[in] cell_set number of each cell's set
   * \param[in] size of blocks: fits reach twice as far */
  BorderFitter(const GridPoints& points,
               const ViewChart& chart,
               const SurfaceCriterion& criterion,
               const std::vector<std::uint32_t>& cell_set,
               BlockSize size)
      : points_(points),
        chart_(chart),
        criterion_(criterion),
        cell_set_(cell_set),
        size_(size)
  {
  }

  /** Nothing when there are too few points. */
  std::optional<BorderFit>
  at(std::uint32_t a, std::uint32_t b, std::size_t cell) const;

private:
  std::array<ViewSums, 2>
  around(std::uint32_t a, std::uint32_t b, std::size_t cell) const;

  const GridPoints& points_;
  const ViewChart& chart_;
  const SurfaceCriterion& criterion_;
  const std::vector<std::uint32_t>& cell_set_;
  BlockSize size_;
};

} // namespace nurbs
} // namespace pcl
