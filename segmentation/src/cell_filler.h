// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "ring_detection.h"

namespace pcl {
namespace nurbs {

/** Put every point into a cell of its raster: the nearest one keeps the cell, others
 * move to a free cell beside it or are dropped. Rings, when given, are the rows; their
 * points keep their order and are dropped when they had to move by over two cells. */
GridLayout
fillCells(const GridGeometry& grid, const ChartList& charts, const Rings& rings);

/** Distance, in cells, that spans nearly all gaps between neighbours of a row. */
int
typicalGap(const GridLayout& layout);

} // namespace nurbs
} // namespace pcl
