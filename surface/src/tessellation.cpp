// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/tessellation.h>

#include "border_sampling.h"
#include "patch_mesher.h"

#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace pcl {
namespace nurbs {
namespace {

bool
isDegenerate(const SurfaceJet1& jet)
{
  constexpr double kParallel = 1e-9;
  return !(jet.du.cross(jet.dv).norm() > kParallel * jet.du.norm() * jet.dv.norm());
}

struct Orientation {
  Eigen::Vector3d normal;
  bool is_degenerate;
};

Orientation
orientationAt(const NurbsSurface& surface, const Eigen::Vector2d& uv)
{
  const SurfaceJet1 jet = surface.evaluateJet1(uv.x(), uv.y());
  if (isDegenerate(jet))
    return {surface.normal(uv.x(), uv.y()), true};
  return {jet.du.cross(jet.dv).normalized(), false};
}

/** For each vertex the one that stands for it: border vertices at the same position
 * whose normals agree are one. At a pole any normals agree. */
std::vector<std::uint32_t>
weldedVertices(const NurbsSurface& surface,
               const TriangleMesh& mesh,
               std::size_t border_vertices)
{
  constexpr double kSameSide = 0.5;
  std::vector<std::uint32_t> stands_for(mesh.vertices.size());
  std::iota(stands_for.begin(), stands_for.end(), 0U);
  std::map<std::tuple<double, double, double>,
           std::vector<std::pair<std::uint32_t, Orientation>>>
      known;
  for (std::uint32_t i = 0; i < border_vertices; ++i) {
    const Eigen::Vector3d& p = mesh.vertices[i];
    auto& here = known[{p.x(), p.y(), p.z()}];
    const Orientation mine = orientationAt(surface, mesh.parameters[i]);
    for (const auto& [vertex, other] : here)
      if (mine.is_degenerate || other.is_degenerate ||
          mine.normal.dot(other.normal) > kSameSide) {
        stands_for[i] = vertex;
        break;
      }
    if (stands_for[i] == i)
      here.emplace_back(i, mine);
  }
  return stands_for;
}

/** Moves the used part of \a patch to the end of \a mesh and adds the normals. */
void
append(const NurbsSurface& surface,
       const TriangleMesh& patch,
       const std::vector<std::uint32_t>& stands_for,
       std::uint32_t patch_index,
       TriangleMesh& mesh)
{
  constexpr std::uint32_t kUnused = ~0U;
  std::vector<std::uint32_t> moved(patch.vertices.size(), kUnused);
  for (const std::array<std::uint32_t, 3>& triangle : patch.triangles) {
    const std::uint32_t a = stands_for[triangle[0]];
    const std::uint32_t b = stands_for[triangle[1]];
    const std::uint32_t c = stands_for[triangle[2]];
    if (a == b || b == c || c == a)
      continue; // at a pole
    for (const std::uint32_t v : {a, b, c})
      if (moved[v] == kUnused) {
        moved[v] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(patch.vertices[v]);
        mesh.parameters.push_back(patch.parameters[v]);
        mesh.normals.push_back(orientationAt(surface, patch.parameters[v]).normal);
      }
    mesh.triangles.push_back({moved[a], moved[b], moved[c]});
  }
  mesh.patch.resize(mesh.vertices.size(), patch_index);
}

void
check(const TessellationOptions& options)
{
  if (!(options.chord_tolerance > 0.0) || !(options.weld_tolerance > 0.0))
    throw std::invalid_argument("tessellate: tolerances must be positive");
  if (!(options.max_edge_length >= 0.0))
    throw std::invalid_argument("tessellate: the longest edge must not be negative");
}

TriangleMesh
tessellatePatches(const std::vector<const TrimmedSurface*>& patches,
                  const TessellationOptions& options)
{
  check(options);
  std::vector<SurfaceGrid> grids;
  grids.reserve(patches.size());
  for (const TrimmedSurface* patch : patches)
    grids.emplace_back(patch->surface(), options);
  const std::vector<std::vector<BorderLoop>> borders =
      sampleBorders(patches, grids, options);
  TriangleMesh mesh;
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const NurbsSurface& surface = patches[k]->surface();
    std::size_t border_vertices = 0;
    const TriangleMesh patch =
        meshPatch(surface, grids[k], borders[k], border_vertices);
    append(surface,
           patch,
           weldedVertices(surface, patch, border_vertices),
           static_cast<std::uint32_t>(k),
           mesh);
  }
  return mesh;
}

} // namespace

TriangleMesh
tessellate(const TrimmedSurface& surface, const TessellationOptions& options)
{
  return tessellatePatches({&surface}, options);
}

TriangleMesh
tessellate(const SurfaceModel& model, const TessellationOptions& options)
{
  std::vector<const TrimmedSurface*> patches;
  patches.reserve(model.patches.size());
  for (const SurfacePatch& patch : model.patches)
    patches.push_back(&patch.geometry);
  return tessellatePatches(patches, options);
}

std::vector<TriangleMesh>
tessellateLevels(const SurfaceModel& model,
                 const TessellationOptions& options,
                 int levels)
{
  if (levels < 1)
    throw std::invalid_argument("tessellateLevels: at least one level is needed");
  std::vector<TriangleMesh> meshes;
  TessellationOptions coarser = options;
  for (int level = 0; level < levels; ++level) {
    meshes.push_back(tessellate(model, coarser));
    coarser.chord_tolerance *= 2.0;
    coarser.max_edge_length *= 2.0;
  }
  return meshes;
}

} // namespace nurbs
} // namespace pcl
