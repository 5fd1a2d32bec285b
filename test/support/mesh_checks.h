// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/tessellation.h>

#include "closed_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace pcl {
namespace nurbs {
namespace test {

struct Topology {
  int euler = 0;
  int border_edges = 0;
  bool is_manifold = true; // no edge with more than two triangles, senses opposite
};

inline Topology
topologyOf(const TriangleMesh& mesh)
{
  std::map<std::pair<unsigned, unsigned>, int> directed;
  std::set<unsigned> used;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      ++directed[{t[i], t[(i + 1) % 3]}];
      used.insert(t[i]);
    }
  Topology result;
  int edges = 0;
  for (const auto& [edge, count] : directed) {
    result.is_manifold &= count == 1 && edge.first != edge.second;
    const bool has_twin = directed.count({edge.second, edge.first}) > 0;
    result.border_edges += has_twin ? 0 : 1;
    edges += has_twin && edge.first > edge.second ? 0 : 1;
  }
  EXPECT_EQ(used.size(), mesh.vertices.size()) << "unused vertices";
  result.euler =
      static_cast<int>(used.size()) - edges + static_cast<int>(mesh.triangles.size());
  return result;
}

inline double
areaOf(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (const auto& t : mesh.triangles)
    area += 0.5 * (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                      .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]])
                      .norm();
  return area;
}

/** Area in the (u, v) domain; a triangle the wrong way round counts negative. */
inline double
domainAreaOf(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector2d a = mesh.parameters[t[1]] - mesh.parameters[t[0]];
    const Eigen::Vector2d b = mesh.parameters[t[2]] - mesh.parameters[t[0]];
    const double twice = a.x() * b.y() - a.y() * b.x();
    EXPECT_GT(twice, -1e-12);
    area += 0.5 * twice;
  }
  return area;
}

/** Greatest distance between points of the surface at parameters inside of triangles
 * and the planes of these triangles. */
inline double
chordErrorOf(const TriangleMesh& mesh, const NurbsSurface& surface)
{
  double error = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d normal = (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                                       .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]])
                                       .normalized();
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j) {
        const Eigen::Vector2d uv =
            (i * mesh.parameters[t[0]] + j * mesh.parameters[t[1]] +
             (4 - i - j) * mesh.parameters[t[2]]) /
            4.0;
        error = std::max(error,
                         std::abs(normal.dot(surface.evaluate(uv.x(), uv.y()) -
                                             mesh.vertices[t[0]])));
      }
  }
  return error;
}

inline TrimLoop
circle(const Eigen::Vector2d& centre, double radius)
{
  const Eigen::Matrix3Xd profile = test::arcProfile(0.0, radius, 0, 4);
  NurbsCurve2::Points points = profile.topRows<2>();
  points.colwise() += centre;
  return TrimLoop({NurbsCurve2::fromControlPoints(
      test::quarterTurns(4), points, profile.row(2).transpose())});
}

inline TessellationOptions
withTolerance(double tolerance)
{
  TessellationOptions options;
  options.chord_tolerance = tolerance;
  return options;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
