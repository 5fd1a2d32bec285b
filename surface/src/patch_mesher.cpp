// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "patch_mesher.h"

#include "planar_triangulation.h"
#include "polygon_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace pcl {
namespace nurbs {
namespace {

enum class Cell : std::uint8_t { Outside, Full, Border };

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
        cells_(static_cast<std::size_t>(grid.cellsU() * grid.cellsV()), Cell::Outside),
        grid_vertex_(grid.u().size() * grid.v().size(), -1),
        origin_(grid.u().front(), grid.v().front())
  {
    const Eigen::Vector2d extent =
        Eigen::Vector2d(grid.u().back(), grid.v().back()) - origin_;
    // Scaled to lengths in space, as far as the lattice allows, triangles that are good
    // in the domain are good in space.
    Eigen::Vector2d lengths = extent.cwiseProduct(grid.scale());
    lengths = lengths.cwiseMax(lengths.maxCoeff() / kMaxAspect);
    if (!(lengths.maxCoeff() > 0.0))
      lengths.setOnes();
    scale_ = lengths.cwiseQuotient(extent) / lengths.maxCoeff();
  }

  std::size_t
  run()
  {
    addBorderVertices();
    const std::size_t border_vertices = mesh_.vertices.size();
    markBorderCells();
    classifyCells();
    if (std::count(cells_.begin(), cells_.end(), Cell::Border) > 0)
      triangulateBorderCells();
    for (int i = 0; i < grid_.cellsU(); ++i)
      for (int j = 0; j < grid_.cellsV(); ++j)
        if (cellAt(i, j) == Cell::Full)
          addCell(i, j);
    return border_vertices;
  }

private:
  static constexpr double kMaxAspect = 4096.0;

  Cell
  cellAt(int i, int j) const
  {
    if (i < 0 || j < 0 || i >= grid_.cellsU() || j >= grid_.cellsV())
      return Cell::Outside;
    return cells_[static_cast<std::size_t>(i * grid_.cellsV() + j)];
  }

  int&
  gridVertex(int i, int j)
  {
    return grid_vertex_[static_cast<std::size_t>(i) * grid_.v().size() +
                        static_cast<std::size_t>(j)];
  }

  Eigen::Vector2d
  gridPoint(int i, int j) const
  {
    return {grid_.u()[static_cast<std::size_t>(i)],
            grid_.v()[static_cast<std::size_t>(j)]};
  }

  Eigen::Vector2d
  scaled(const Eigen::Vector2d& uv) const
  {
    return (uv - origin_).cwiseProduct(scale_);
  }

  LatticePoint
  latticePoint(const Eigen::Vector2d& uv) const
  {
    const Eigen::Vector2d steps =
        scaled(uv) * static_cast<double>(PlanarTriangulation::kResolution);
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
      const Eigen::Vector2d uv = gridPoint(i, j);
      vertex = addMeshVertex(uv, surface_.evaluate(uv.x(), uv.y()));
    }
    return vertex;
  }

  /** Index of the grid point at \a cell coordinates, if they are whole. */
  static bool
  isGridPoint(const Eigen::Vector2d& cell)
  {
    return cell.x() == std::floor(cell.x()) && cell.y() == std::floor(cell.y());
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
  markBorderCells()
  {
    for (const BorderLoop& loop : loops_)
      for (std::size_t k = 0; k < loop.size(); ++k)
        markSegment(grid_.cellCoordinates(loop[k].parameter),
                    grid_.cellCoordinates(loop[(k + 1) % loop.size()].parameter));
  }

  void
  markSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
  {
    if (isGridPoint(a) && isGridPoint(b) && (a - b).lpNorm<1>() == 1.0)
      return; // a side of a cell
    // Segments are not longer than a cell, so their box is close to them. The margin
    // keeps cells clear of edges by more than a lattice step.
    constexpr double kMargin = 1e-3;
    const Eigen::Vector2d low = a.cwiseMin(b).array() - kMargin;
    const Eigen::Vector2d high = a.cwiseMax(b).array() + kMargin;
    const auto bounded = [](double cell, int count) {
      return std::clamp(static_cast<int>(std::floor(cell)), 0, count - 1);
    };
    for (int i = bounded(low.x(), grid_.cellsU());
         i <= bounded(high.x(), grid_.cellsU());
         ++i)
      for (int j = bounded(low.y(), grid_.cellsV());
           j <= bounded(high.y(), grid_.cellsV());
           ++j)
        cells_[static_cast<std::size_t>(i * grid_.cellsV() + j)] = Cell::Border;
  }

  void
  classifyCells()
  {
    // Inner points of the grid keep away from the border by a part of a cell: closer
    // ones would make slivers, and might split an edge that another patch has whole.
    constexpr double kClearance = 0.1;
    double least = HUGE_VAL;
    for (std::size_t i = 1; i < grid_.u().size(); ++i)
      least = std::min(least, (grid_.u()[i] - grid_.u()[i - 1]) * scale_.x());
    for (std::size_t j = 1; j < grid_.v().size(); ++j)
      least = std::min(least, (grid_.v()[j] - grid_.v()[j - 1]) * scale_.y());
    std::vector<std::vector<Eigen::Vector2d>> polygons;
    for (const BorderLoop& loop : loops_) {
      polygons.emplace_back();
      for (const BorderSample& sample : loop)
        polygons.back().push_back(scaled(sample.parameter));
    }
    inside_.emplace(polygons, kClearance * least);
    for (int i = 0; i < grid_.cellsU(); ++i)
      for (int j = 0; j < grid_.cellsV(); ++j) {
        Cell& cell = cells_[static_cast<std::size_t>(i * grid_.cellsV() + j)];
        const Eigen::Vector2d middle =
            0.5 * (gridPoint(i, j) + gridPoint(i + 1, j + 1));
        if (cell == Cell::Outside && inside_->contains(scaled(middle)))
          cell = Cell::Full;
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
    const LatticePoint& point = plane_.point(id);
    planarVertex(point, -1);
    int& known = mesh_vertex_of_[static_cast<std::size_t>(id)];
    if (known < 0) {
      const Eigen::Vector2d uv =
          origin_ +
          Eigen::Vector2d(static_cast<double>(point.x), static_cast<double>(point.y))
                  .cwiseQuotient(scale_) /
              static_cast<double>(PlanarTriangulation::kResolution);
      known = addMeshVertex(uv, surface_.evaluate(uv.x(), uv.y()));
    }
    return known;
  }

  void
  addGridPoints()
  {
    for (int i = 0; i <= grid_.cellsU(); ++i)
      for (int j = 0; j <= grid_.cellsV(); ++j) {
        const std::array<Cell, 4> around = {
            cellAt(i - 1, j - 1), cellAt(i - 1, j), cellAt(i, j - 1), cellAt(i, j)};
        const auto has = [&](Cell kind) {
          return std::find(around.begin(), around.end(), kind) != around.end();
        };
        const bool in_wall = has(Cell::Full) && !(around == kAllFull);
        if (in_wall || (has(Cell::Border) && isWellInside(gridPoint(i, j))))
          planarVertex(latticePoint(gridPoint(i, j)), meshVertex(i, j));
      }
  }

  bool
  isWellInside(const Eigen::Vector2d& uv) const
  {
    return inside_->contains(scaled(uv)) && !inside_->isOnBorder(scaled(uv));
  }

  void
  addWalls()
  {
    const auto wall = [&](int i, int j, int k, int l) {
      plane_.addConstraint(plane_.addVertex(latticePoint(gridPoint(i, j))),
                           plane_.addVertex(latticePoint(gridPoint(k, l))),
                           kWall);
    };
    for (int i = 0; i < grid_.cellsU(); ++i)
      for (int j = 0; j < grid_.cellsV(); ++j) {
        if (cellAt(i, j) != Cell::Full)
          continue;
        if (cellAt(i, j - 1) != Cell::Full)
          wall(i, j, i + 1, j);
        if (cellAt(i + 1, j) != Cell::Full)
          wall(i + 1, j, i + 1, j + 1);
        if (cellAt(i, j + 1) != Cell::Full)
          wall(i + 1, j + 1, i, j + 1);
        if (cellAt(i - 1, j) != Cell::Full)
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
  std::vector<Cell> cells_;
  std::vector<int> grid_vertex_; // of the mesh, -1 before use
  std::vector<std::vector<int>> border_;
  Eigen::Vector2d origin_;
  Eigen::Vector2d scale_; // the larger side of the domain becomes 1
  std::optional<PolygonIndex> inside_;
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
