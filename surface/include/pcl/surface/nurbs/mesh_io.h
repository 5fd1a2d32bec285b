// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/exports.h>
#include <pcl/surface/nurbs/triangle_mesh.h>

#include <string>

namespace pcl {
namespace nurbs {

/** \brief Write a mesh as Wavefront OBJ: v, vt (the parameters u, v), vn and f, with
 * one group "patch_K" for each patch K that has triangles, in increasing order.
 * Positions have 9 significant digits.
 *
 * The file appears under its name only when it is complete.
 * \param[in] path file to write
 * \param[in] mesh the mesh
 * \throws std::invalid_argument for a mesh whose vectors differ in length or whose
 * triangles name vertices that are not there
 * \throws std::runtime_error "cannot write PATH: reason"
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT void
writeObjMesh(const std::string& path, const TriangleMesh& mesh);

/** \brief Write a mesh as binary little-endian PLY: per vertex x y z nx ny nz (float)
 * and patch (uint), per face a list vertex_indices (uchar count, int).
 *
 * The file appears under its name only when it is complete.
 * \param[in] path file to write
 * \param[in] mesh the mesh
 * \throws std::invalid_argument, std::runtime_error like writeObjMesh()
 * \ingroup surface */
PCL_NURBS_SURFACE_EXPORT void
writePlyMesh(const std::string& path, const TriangleMesh& mesh);

} // namespace nurbs
} // namespace pcl
