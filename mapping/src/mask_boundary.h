// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Closed chain of lattice corners; corner (c, r) is where the cells (c - 1, r -
 * 1) and (c, r) touch. First corner not repeated; straight runs are one edge. */
using LatticeLoop = std::vector<Eigen::Vector2i>;

/** \brief Set of cells of a grid. */
struct CellMask {
  int width = 0;
  int height = 0;
  std::vector<char> cells; /**< row by row, 0 or 1 */

  bool
  at(int column, int row) const
  {
    return column >= 0 && row >= 0 && column < width && row < height &&
           cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(column)] != 0;
  }
};

/** \brief Border of a mask: around cells counter-clockwise in (column, row), around
 * holes clockwise, so that the mask is on the left. Cells that touch in a corner only
 * are apart. O(cells). */
std::vector<LatticeLoop>
traceBoundary(const CellMask& mask);

} // namespace nurbs
} // namespace pcl
