// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Point on the integer lattice that makes every geometric test exact. */
struct LatticePoint {
  std::int64_t x, y;

  bool
  operator==(const LatticePoint& other) const
  {
    return x == other.x && y == other.y;
  }
};

/** \brief What a directed edge a -> b separates: region k is entered so many times when
 * the edge is crossed from its right to its left. */
using EdgeCounts = std::array<int, 2>;

/** \brief Constrained Delaunay triangulation of a rectangle, on a lattice.
 *
 * Coordinates are rounded to a lattice of kResolution steps, which makes orientation
 * and circle tests exact in integers: collinear points, staircases, repeated corners
 * and edges that touch or cross need no tolerance and no special case by the caller.
 * Edges that cross get a new vertex. Closed chains of constrained edges carry winding
 * numbers, so regions come out by counting, whatever the chains do to each other.
 *
 * Insertion: Lawson's flips along a walk from the last vertex; constraints: flips of
 * the crossed edges (Sloan, 1993).
 */
class PlanarTriangulation {
public:
  static constexpr std::int64_t kResolution = std::int64_t{1} << 28;

  PlanarTriangulation();

  /** \brief Vertex at \a point, the one that is there already if there is one.
   * \param[in] point coordinates 0..kResolution */
  int
  addVertex(const LatticePoint& point);

  /** \brief Make a -> b a chain of edges and add \a counts to what they separate.
   * \throws std::domain_error if crossings multiply without end */
  void
  addConstraint(int a, int b, const EdgeCounts& counts);

  /** \brief One past the greatest vertex; vertices from crossings are included. */
  int
  numVertices() const
  {
    return static_cast<int>(points_.size());
  }

  const LatticePoint&
  point(int vertex) const
  {
    return points_[static_cast<std::size_t>(vertex)];
  }

  struct LabelledTriangle {
    std::array<int, 3> vertices; /**< counter-clockwise */
    EdgeCounts windings;         /**< per region, how often its chains wind around */
  };

  /** \brief The triangles for which a region has a winding number other than 0. */
  std::vector<LabelledTriangle>
  labelledTriangles() const;

private:
  static constexpr int kFrameCorners = 4;

  static constexpr int
  next(int i)
  {
    return i == 2 ? 0 : i + 1;
  }

  static constexpr int
  previous(int i)
  {
    return i == 0 ? 2 : i - 1;
  }

  static int
  indexOf(const std::array<int, 3>& values, int value)
  {
    return values[0] == value ? 0 : values[1] == value ? 1 : 2;
  }

  struct Triangle {
    std::array<int, 3> vertex;    // counter-clockwise
    std::array<int, 3> neighbour; // across the edge opposite of vertex i, or -1
    std::array<EdgeCounts, 3> counts{};
    std::array<bool, 3> fixed{};
  };
  struct Side {
    int triangle, index;
  };
  struct Constraint {
    int a, b;
    EdgeCounts counts;
  };

  int
  orientation(int a, int b, const LatticePoint& c) const;
  bool
  isInCircle(const Triangle& triangle, int vertex) const;
  int
  locate(const LatticePoint& point) const;
  void
  link(Side a, Side b);
  void
  relink(Side from, Side to);
  void
  splitTriangle(int triangle, int vertex);
  void
  splitSide(Side side, int vertex);
  void
  flip(Side side);
  bool
  isConvex(Side side) const;
  void
  legalize(std::vector<Side>& stack);
  Side
  findSide(int a, int b) const;
  Side
  firstCrossing(int a, int b, int& on_segment) const;
  bool
  collectCrossings(Constraint& constraint,
                   std::vector<Constraint>& pending,
                   std::vector<std::pair<int, int>>& crossed);
  void
  splitCrossing(Side side,
                const Constraint& constraint,
                std::vector<Constraint>& pending);
  void
  flipCrossings(int a, int b, std::vector<std::pair<int, int>> crossed);
  void
  mark(Side side, const EdgeCounts& counts);

  std::vector<LatticePoint> points_;
  std::vector<int> triangle_of_; // some triangle of each vertex
  std::vector<Triangle> triangles_;
  std::unordered_map<std::uint64_t, int> vertex_at_;
  mutable int last_ = 0; // where the next walk starts
};

} // namespace nurbs
} // namespace pcl
