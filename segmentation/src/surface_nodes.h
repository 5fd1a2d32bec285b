// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "kept_edges.h"

#include <pcl/segmentation/view_polynomial.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** Columns and rows of a block of cells. */
struct BlockSize {
  int columns;
  int rows;
};

/** Two nodes with edges between them; a < b. */
struct NodeLink {
  std::uint32_t a;
  std::uint32_t b;
  float border; /**< neighbouring cells in rows and columns */
  float weight; /**< sum of the edges' weights */
};

/** Blocks of cells that are one smooth piece each, in order of their rate. */
class SurfaceNodes {
public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  SurfaceNodes(const GridPoints& points,
               const KeptEdges& edges,
               const ViewChart& chart);

  /** Add every block of free cells of this size that has no cut inside and is smooth
   * within \a sigmas standard deviations. */
  void
  addBlocks(BlockSize size, double sigmas, int threads);

  /** Links of nodes from \a first on with each other and with those before; sorted. */
  std::vector<NodeLink>
  links(std::uint32_t first, int threads) const;

  std::uint32_t
  count() const
  {
    return static_cast<std::uint32_t>(sums_.size());
  }

  const ViewSums&
  sums(std::uint32_t node) const
  {
    return sums_[node];
  }

  /** Number of a node's block, row by row, among those of its size. */
  std::size_t
  block(std::uint32_t node) const
  {
    return block_[node];
  }

  /** Node of each cell, or kNone. */
  const std::vector<std::uint32_t>&
  ofCell() const
  {
    return of_cell_;
  }

private:
  struct Block;

  bool
  cutInside(std::size_t cell, BlockSize size) const;

  Block
  gather(std::size_t block, BlockSize size) const;

  void
  append(const std::vector<Block>& blocks, BlockSize size, double limit);

  const GridPoints& points_;
  const KeptEdges& edges_;
  const ViewChart& chart_;
  std::vector<std::uint32_t> of_cell_;
  std::vector<ViewSums> sums_;
  std::vector<std::size_t> block_;
};

/** How much larger than stated the noise is, at least 1: from what blocks of cells
 * deviate from smooth ones, whether or not they hold a jump; a lower quantile of a
 * sample of them. */
double
measureNoiseScale(const GridPoints& points,
                  const ViewChart& chart,
                  BlockSize size,
                  int threads);

} // namespace nurbs
} // namespace pcl
