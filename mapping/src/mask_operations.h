// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "mask_boundary.h"

#include <pcl/segmentation/grid_geometry.h>

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Close cells that most of their neighbours surround and, where samples lie
 * apart, gaps between them: every cell that no square of 2 (gap / 2) + 1 cells without
 * a set cell covers. O(cells).
 * \param[in] mask any mask
 * \param[in] gap how many cells apart samples of one surface lie; 1 = side by side */
CellMask
closed(const CellMask& mask, int gap);

/** \brief Clear connected parts (4-neighbours) with few samples. O(cells).
 * \param[in,out] mask any mask
 * \param[in] samples the cells of the mask that count
 * \param[in] fewest parts with fewer of them are cleared */
void
clearSmallParts(CellMask& mask, const CellMask& samples, int fewest);

/** \brief Connected parts of a set of cells, each in increasing order. Cells are
 * connected to their 4 neighbours and, where samples lie apart, to all that are at most
 * \a max_gap cells away in either direction.
 * \param[in] geometry the grid; its max_gap and wrap count
 * \param[in] cells different cells of the grid
 * \param[in,out] scratch empty, or what the last call left: saves time */
std::vector<std::vector<std::int32_t>>
connectedParts(const GridGeometry& geometry,
               const std::vector<std::int32_t>& cells,
               std::vector<char>& scratch);

} // namespace nurbs
} // namespace pcl
