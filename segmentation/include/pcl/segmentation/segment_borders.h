// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_graph.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Border that two segments share. */
struct SegmentBorder {
  std::uint32_t first;  /**< smaller label */
  std::uint32_t second; /**< larger label */
  std::size_t cells;    /**< pairs of neighbours in rows and columns */
  /** Length in the cloud's unit, as far as it is seen by the sensor: cells times the
   * spacing of neighbours along the border at their depth. In a lattice, whose spacing
   * nobody knows, the number of cells. */
  double length;
};

/** \brief Segments that touch, with the length of their border. Pairs over edges that
 * are removed, as over depth jumps, do not touch. O(cells + borders log borders).
 * \param[in] points organized points
 * \param[in] graph their graph, with weights
 * \param[in] labels label per cell, 0 = none
 * \param[in] min_weight edges with a smaller weight are removed
 * \return borders by increasing first and second label
 * \throws std::invalid_argument when graph or labels belong to other points
 */
PCL_NURBS_SEGMENTATION_EXPORT std::vector<SegmentBorder>
segmentBorders(const GridPoints& points,
               const GridGraph& graph,
               const std::vector<std::uint32_t>& labels,
               float min_weight);

} // namespace nurbs
} // namespace pcl
