// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "surface_borders.h"

namespace pcl {
namespace nurbs {

/** Give the cells of a facet to its neighbours when that is cheaper than to store it:
 * blocks on a fold make strips of facets that the surfaces on both sides explain point
 * by point. Smallest facets first; O(cells) for small facets, large ones are given up
 * on early. */
void
dropRedundantFacets(const JoiningInput& input,
                    const KeptEdges& edges,
                    CellFacets& cells);

} // namespace nurbs
} // namespace pcl
