// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Triangles over shared vertices, with what a renderer or writer needs of the
 * surface at each vertex. All vectors but \a triangles have one entry per vertex.
 * \ingroup surface
 */
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;               /**< metres */
  std::vector<Eigen::Vector3d> normals;                /**< unit */
  std::vector<Eigen::Vector2d> parameters;             /**< (u, v) of the patch */
  std::vector<std::uint32_t> patch;                    /**< index into the model */
  std::vector<std::array<std::uint32_t, 3>> triangles; /**< counter-clockwise */
};

} // namespace nurbs
} // namespace pcl
