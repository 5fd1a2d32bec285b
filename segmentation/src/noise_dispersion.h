// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "surface_nodes.h"

namespace pcl {
namespace nurbs {

/** What a superfluous coefficient lowers the misfit by: 1 for independent noise of the
 * stated size, more where neighbouring points err alike (64 pixels of one error make it
 * 64) or the noise is larger than stated.
 *
 * Measured on squares of 2 x 2 blocks of one surface: the misfit of one model for all
 * less that of a model each, divided by the coefficients saved; a lower quantile, for
 * some of the squares hold a fold. Squares of blocks twice as wide as \a size are used
 * if there are enough, as errors are alike over long distances.
 * \param[in] nodes blocks of size \a size and no others
 * \return nothing smaller than 1/4: exact points would make every curve significant; 1
 * when there are too few blocks to tell. O(nodes) */
double
noiseDispersion(const GridGeometry& grid,
                const SurfaceNodes& nodes,
                const ViewChart& chart,
                BlockSize size);

} // namespace nurbs
} // namespace pcl
