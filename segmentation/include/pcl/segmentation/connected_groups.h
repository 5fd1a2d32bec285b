// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_graph.h>

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief What separates two groups of connectedGroups(). */
struct ConnectedGroupsOptions {
  /** Edges with a smaller weight are removed. */
  float min_weight = 1e-4F;
  /** A depth jump is what leaves the line of the neighbours by more than this many
   * standard deviations of the noise, plus a share of the point spacing. */
  float jump_sigmas = 3.0F;
  /** Whether groups end where the surface folds. */
  bool split_creases = true;
  /** Angle (radians) the normals must turn by over the fold, in excess of how the
   * surface curves beside it. */
  float crease_angle = 0.5F;
  /** Groups of fewer points are dropped. */
  std::size_t min_size = 100;
  /** Number of threads; the result does not depend on it. */
  int threads = 1;
};

/** \brief Group the points of a grid into connected sheets.
 *
 * (1) Edges of low weight and edges over a depth jump are removed. The jump test is a
 * second difference along the grid line of the edge, in inverse depth for a sensor's
 * grid, where a plane at any angle has none: floors seen at grazing angle stay whole.
 * (2) Normals from line fits along rows and columns that never cross a removed edge,
 * over windows just wide enough for the noise; points on a fold are set aside.
 * (3) Union-find over what is left; then the folds are shared out among the groups they
 * touch. O(cells), the same result for the same input.
 *
 * \param[in] points organized points
 * \param[in] graph their graph, with weights
 * \param[in] noise depth noise of the sensor
 * \param[in] options thresholds
 * \param[out] labels per cell: 0 = none, 1.. by decreasing size of the group
 * \return number of groups
 * \throws std::invalid_argument when the graph belongs to other points or a threshold
 * is not positive
 */
PCL_NURBS_SEGMENTATION_EXPORT std::uint32_t
connectedGroups(const GridPoints& points,
                const GridGraph& graph,
                const SensorNoise& noise,
                const ConnectedGroupsOptions& options,
                std::vector<std::uint32_t>& labels);

} // namespace nurbs
} // namespace pcl
