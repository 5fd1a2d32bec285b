// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "patch_mesher.h"

#include "grid_cells.h"
#include "planar_triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr EdgeCounts kTrim = {1, 0}; // the patch lies on the left
constexpr EdgeCounts kWall = {0, 1}; // cells that need no triangulation, on the left

class PatchMesher {
public:
  PatchMesher(const NurbsSurface& surface,
              const SurfaceGrid& grid,
              const std::vector<BorderLoop>& loops,
              TriangleMesh& mesh)
      : surface_(surface),
        grid_(grid),
        loops_(loops),
        mesh_(mesh),
        cells_(grid, loops),
        grid_vertex_(grid.u().size() * grid.v().size(), -1)
  {
  }

  std::size_t
  run()
  {
    addBorderVertices();
    const std::size_t border_vertices = mesh_.vertices.size();
    if (!cells_.areAllWhole())
      triangulateBorderCells();
    for (int i = 0; i < grid_.cellsU(); ++i)
      for (int j = 0; j < grid_.cellsV(); ++j)
        if (cells_.at(i, j) == Cell::Full)
          addCell(i, j);
    return border_vertices;
  }

private:
  int&
  gridVertex(int i, int j)
  {
    return grid_vertex_[static_cast<std::size_t>(i) * grid_.v().size() +
                        static_cast<std::size_t>(j)];
  }

  LatticePoint
  latticePoint(const Eigen::Vector2d& uv) const
  {
    const Eigen::Vector2d steps =
        cells_.scaled(uv) * static_cast<double>(PlanarTriangulation::kResolution);
    return {std::llround(steps.x()), std::llround(steps.y())};
  }

  int
  addMeshVertex(const Eigen::Vector2d& uv, const Eigen::Vector3d& position)
  {
    mesh_.parameters.push_back(uv);
    mesh_.vertices.push_back(position);
    return static_cast<int>(mesh_.vertices.size()) - 1;
  }

  /** Vertex of the mesh at a grid point, made at first use. */
  int
  meshVertex(int i, int j)
  {
    int& vertex = gridVertex(i, j);
    if (vertex < 0) {
      const Eigen::Vector2d uv = cells_.point(i, j);
      vertex = addMeshVertex(uv, surface_.evaluate(uv.x(), uv.y()));
    }
    return vertex;
  }

  void
  addBorderVertices()
  {
    for (const BorderLoop& loop : loops_) {
      border_.emplace_back();
      for (const BorderSample& sample : loop) {
        const Eigen::Vector2d cell = grid_.cellCoordinates(sample.parameter);
        int* const known = isGridPoint(cell) ? &gridVertex(static_cast<int>(cell.x()),
                                                           static_cast<int>(cell.y()))
                                             : nullptr;
        const int vertex = known != nullptr && *known >= 0
                               ? *known
                               : addMeshVertex(sample.parameter, sample.position);
        if (known != nullptr)
          *known = vertex;
        border_.back().push_back(vertex);
      }
    }
  }

  void
  triangulateBorderCells()
  {
    std::vector<std::vector<int>> ids;
    for (std::size_t k = 0; k < loops_.size(); ++k) {
      ids.emplace_back();
      for (std::size_t i = 0; i < loops_[k].size(); ++i)
        ids.back().push_back(
            planarVertex(latticePoint(loops_[k][i].parameter), border_[k][i]));
    }
    addGridPoints();
    for (const std::vector<int>& loop : ids)
      for (std::size_t i = 0; i < loop.size(); ++i)
        plane_.addConstraint(loop[i], loop[(i + 1) % loop.size()], kTrim);
    addWalls();
    for (const int axis : {0, 1})
      for (const int line : grid_.creases(axis))
        addCrease(axis, line);
    for (const auto& triangle : plane_.labelledTriangles())
      if (triangle.windings[0] != 0 && triangle.windings[1] == 0)
        addTriangle(meshVertexOf(triangle.vertices[0]),
                    meshVertexOf(triangle.vertices[1]),
                    meshVertexOf(triangle.vertices[2]));
  }

  /** Vertex of the triangulation for a vertex of the mesh; the first comes first. */
  int
  planarVertex(const LatticePoint& point, int mesh_vertex)
  {
    const int id = plane_.addVertex(point);
    const auto needed = static_cast<std::size_t>(id) + 1;
    if (mesh_vertex_of_.size() < needed)
      mesh_vertex_of_.resize(needed, -1);
    int& known = mesh_vertex_of_[static_cast<std::size_t>(id)];
    if (known < 0)
      known = mesh_vertex;
    return id;
  }

  /** Vertices where edges of loops cross are new to the mesh. */
  int
  meshVertexOf(int id)
  {
    planarVertex(plane_.point(id), -1);
    int& known = mesh_vertex_of_[static_cast<std::size_t>(id)];
    if (known < 0) {
      const Eigen::Vector2d uv = cells_.unscaled(latticeUnit(id));
      known = addMeshVertex(uv, surface_.evaluate(uv.x(), uv.y()));
    }
    return known;
  }

  void
  addGridPoints()
  {
    for (int i = 0; i <= grid_.cellsU(); ++i)
      for (int j = 0; j <= grid_.cellsV(); ++j) {
        const std::array<Cell, 4> around = {cells_.at(i - 1, j - 1),
                                            cells_.at(i - 1, j),
                                            cells_.at(i, j - 1),
                                            cells_.at(i, j)};
        const auto has = [&](Cell kind) {
          return std::find(around.begin(), around.end(), kind) != around.end();
        };
        const bool in_wall = has(Cell::Full) && !(around == kAllFull);
        if (in_wall || (has(Cell::Border) &&
                        cells_.isWellInside(cells_.scaled(cells_.point(i, j)))))
          planarVertex(latticePoint(cells_.point(i, j)), meshVertex(i, j));
      }
  }

  /** Edges along a line of the grid through all vertices on it. Loops cross creases
   * only at vertices, so these edges do not cross them. */
  void
  addCrease(int axis, int line)
  {
    const LatticePoint on_line =
        latticePoint(axis == 0 ? cells_.point(line, 0) : cells_.point(0, line));
    std::vector<std::pair<std::int64_t, int>> along;
    for (std::size_t id = 0; id < mesh_vertex_of_.size(); ++id) {
      if (mesh_vertex_of_[id] < 0)
        continue;
      const LatticePoint& point = plane_.point(static_cast<int>(id));
      if (axis == 0 && point.x == on_line.x)
        along.emplace_back(point.y, id);
      else if (axis == 1 && point.y == on_line.y)
        along.emplace_back(point.x, id);
    }
    std::sort(along.begin(), along.end());
    for (std::size_t k = 1; k < along.size(); ++k) {
      const int a = along[k - 1].second;
      const int b = along[k].second;
      if (cells_.isInside(0.5 * (latticeUnit(a) + latticeUnit(b))))
        plane_.addConstraint(a, b, EdgeCounts{});
    }
  }

  /** Vertex of the triangulation in scaled coordinates. */
  Eigen::Vector2d
  latticeUnit(int id) const
  {
    const LatticePoint& point = plane_.point(id);
    return Eigen::Vector2d(static_cast<double>(point.x), static_cast<double>(point.y)) /
           static_cast<double>(PlanarTriangulation::kResolution);
  }

  void
  addWalls()
  {
    const auto wall = [&](int i, int j, int k, int l) {
      plane_.addConstraint(plane_.addVertex(latticePoint(cells_.point(i, j))),
                           plane_.addVertex(latticePoint(cells_.point(k, l))),
                           kWall);
    };
    for (int i = 0; i < grid_.cellsU(); ++i)
      for (int j = 0; j < grid_.cellsV(); ++j) {
        if (cells_.at(i, j) != Cell::Full)
          continue;
        if (cells_.at(i, j - 1) != Cell::Full)
          wall(i, j, i + 1, j);
        if (cells_.at(i + 1, j) != Cell::Full)
          wall(i + 1, j, i + 1, j + 1);
        if (cells_.at(i, j + 1) != Cell::Full)
          wall(i + 1, j + 1, i, j + 1);
        if (cells_.at(i - 1, j) != Cell::Full)
          wall(i, j + 1, i, j);
      }
  }

  void
  addCell(int i, int j)
  {
    const std::array<int, 4> corner = {meshVertex(i, j),
                                       meshVertex(i + 1, j),
                                       meshVertex(i + 1, j + 1),
                                       meshVertex(i, j + 1)};
    const auto length2 = [&](int a, int b) {
      return (mesh_.vertices[static_cast<std::size_t>(corner[a])] -
              mesh_.vertices[static_cast<std::size_t>(corner[b])])
          .squaredNorm();
    };
    const int first = length2(0, 2) <= length2(1, 3) ? 0 : 1;
    for (const int k : {first, first + 2})
      addTriangle(corner[k], corner[(k + 1) % 4], corner[(k + 2) % 4]);
  }

  void
  addTriangle(int a, int b, int c)
  {
    mesh_.triangles.push_back({static_cast<std::uint32_t>(a),
                               static_cast<std::uint32_t>(b),
                               static_cast<std::uint32_t>(c)});
  }

  static constexpr std::array<Cell, 4> kAllFull = {
      Cell::Full, Cell::Full, Cell::Full, Cell::Full};

  const NurbsSurface& surface_;
  const SurfaceGrid& grid_;
  const std::vector<BorderLoop>& loops_;
  TriangleMesh& mesh_;
  GridCells cells_;
  std::vector<int> grid_vertex_; // of the mesh, -1 before use
  std::vector<std::vector<int>> border_;
  PlanarTriangulation plane_;
  std::vector<int> mesh_vertex_of_; // by vertex of plane_
};

} // namespace

TriangleMesh
meshPatch(const NurbsSurface& surface,
          const SurfaceGrid& grid,
          const std::vector<BorderLoop>& loops,
          std::size_t& border_vertices)
{
  TriangleMesh mesh;
  border_vertices = PatchMesher(surface, grid, loops, mesh).run();
  return mesh;
}

} // namespace nurbs
} // namespace pcl
