// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/tessellation.h>

#include "surface_grid.h"

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A point of a patch's border. */
struct BorderSample {
  Eigen::Vector2d parameter; /**< of the patch */
  Eigen::Vector3d position;  /**< equal to the last bit in all patches that meet here */
};

/** \brief Closed polygon along a loop. */
using BorderLoop = std::vector<BorderSample>;

/** \brief Polygons along the loops of all patches, equal where patches meet.
 *
 * Loops are cut into pieces: single edges of straight-edged curves, else whole curves.
 * Pieces with the same ends in space and the same points between are one border: its
 * first piece is sampled, halving until the polygon is within the tolerance and no edge
 * spans more than a grid cell of any of the patches; the others take the points over.
 * \param[in] patches the surfaces
 * \param[in] grids their grids, in the same order
 * \param[in] options tolerances
 * \return loops[patch]; the whole domain's border for a patch without loops
 */
std::vector<std::vector<BorderLoop>>
sampleBorders(const std::vector<const TrimmedSurface*>& patches,
              const std::vector<SurfaceGrid>& grids,
              const TessellationOptions& options);

} // namespace nurbs
} // namespace pcl
