// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "surface_joining.h"

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** Number the surfaces that are large enough 1.. by decreasing size and describe them.
 * \param[in] input facets with a model and where they come from
 * \param[in] cell_facet facet of each cell, also of such without a model
 * \param[in] surfaces sets of facets
 * \param[out] labels per cell, 0 for none
 * \param[out] groups the surfaces, if wanted
 * \return number of surfaces */
std::uint32_t
labelSurfaces(const JoiningInput& input,
              const std::vector<std::uint32_t>& cell_facet,
              DisjointSets& surfaces,
              std::vector<std::uint32_t>& labels,
              std::vector<SurfaceGroup>* groups);

} // namespace nurbs
} // namespace pcl
