// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/triangle_mesh.h>

#include "border_sampling.h"

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Triangles of one patch, without normals.
 *
 * Vertices may be unused, and vertices on the border are not yet welded.
 * \param[in] surface the surface
 * \param[in] grid its grid
 * \param[in] loops its border, as sampleBorders() gives it
 * \param[out] border_vertices how many vertices, from the first, lie on the border
 */
TriangleMesh
meshPatch(const NurbsSurface& surface,
          const SurfaceGrid& grid,
          const std::vector<BorderLoop>& loops,
          std::size_t& border_vertices);

} // namespace nurbs
} // namespace pcl
