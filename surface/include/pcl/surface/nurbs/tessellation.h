// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/surface_model.h>
#include <pcl/surface/nurbs/triangle_mesh.h>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief How fine triangles are. Lengths in the unit of the control points (metres).
 */
struct TessellationOptions {
  /** Largest distance between the surface or a trimming curve and the triangles. */
  double chord_tolerance = 1e-3;
  /** Largest edge, 0 for no limit: for meshes that carry a value per vertex. */
  double max_edge_length = 0.0;
  /** Borders that agree to this distance are one border. */
  double weld_tolerance = 1e-6;
};

/** \brief Triangles of a trimmed surface.
 *
 * The domain gets a grid that follows the curvature of each knot span. Cells that no
 * trimming curve touches give two triangles; the strip between them and the trimming
 * curves is filled by a constrained Delaunay triangulation with exact predicates, so
 * any loop is handled: staircases of a pixel mask, touching, collinear or crossing
 * edges. Inside of a patch every edge has two triangles. Where the sides of a domain
 * meet in space (seam of a cylinder, sphere or torus) or collapse (pole) and the
 * normals agree, the vertices are the same.
 *
 * Vertices of a seam have the parameters of one of its sides.
 * \param[in] surface the surface and its loops
 * \param[in] options fineness
 * \return mesh whose patch indices are 0; empty if the loops enclose nothing
 * \throws std::invalid_argument for tolerances that are not positive
 * \throws std::domain_error if the tolerance needs more than 2^24 grid points
 * Cost: one evaluation per vertex; a 256 x 256 grid takes about 20 ms.
 * \ingroup surface
 */
PCL_NURBS_SURFACE_EXPORT TriangleMesh
tessellate(const TrimmedSurface& surface, const TessellationOptions& options = {});

/** \brief Triangles of all patches of a model in one mesh.
 *
 * Watertight between patches: curves of loops (edges, for loops of straight edges) that
 * coincide in space within the weld tolerance, whatever their parameters and sense, are
 * sampled once, fine enough for all patches that meet there, and every patch uses these
 * very points. Curves that coincide only in part are not recognised. Vertices are not
 * shared between patches, only their positions are equal to the last bit.
 * \ingroup surface
 */
PCL_NURBS_SURFACE_EXPORT TriangleMesh
tessellate(const SurfaceModel& model, const TessellationOptions& options = {});

/** \brief Levels of detail: level k has the chord tolerance and the longest edge of
 * \a options times 2^k, level 0 is the finest.
 * \throws std::invalid_argument for less than one level
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT std::vector<TriangleMesh>
tessellateLevels(const SurfaceModel& model,
                 const TessellationOptions& options,
                 int levels);

} // namespace nurbs
} // namespace pcl
