// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "planar_triangulation.h"

#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

EdgeCounts
negated(const EdgeCounts& counts)
{
  return {-counts[0], -counts[1]};
}

bool
isAhead(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p)
{
  return (b.x - a.x) * (p.x - a.x) + (b.y - a.y) * (p.y - a.y) > 0;
}

/** Lattice point nearest to where the lines a-b and p-q cross. */
LatticePoint
crossingOf(const LatticePoint& a,
           const LatticePoint& b,
           const LatticePoint& p,
           const LatticePoint& q)
{
  const auto dx = static_cast<double>(b.x - a.x);
  const auto dy = static_cast<double>(b.y - a.y);
  const auto ex = static_cast<double>(q.x - p.x);
  const auto ey = static_cast<double>(q.y - p.y);
  const auto fx = static_cast<double>(p.x - a.x);
  const auto fy = static_cast<double>(p.y - a.y);
  const double t = (fx * ey - fy * ex) / (dx * ey - dy * ex);
  return {a.x + std::llround(t * dx), a.y + std::llround(t * dy)};
}

} // namespace

void
PlanarTriangulation::mark(Side side, const EdgeCounts& counts)
{
  Triangle& triangle = triangles_[side.triangle];
  const int n = triangle.neighbour[side.index];
  const int j = indexOf(triangles_[n].neighbour, side.triangle);
  for (std::size_t k = 0; k < counts.size(); ++k) {
    triangle.counts[side.index][k] += counts[k];
    triangles_[n].counts[j][k] -= counts[k];
  }
  triangle.fixed[side.index] = true;
  triangles_[n].fixed[j] = true;
}

PlanarTriangulation::Side
PlanarTriangulation::findSide(int a, int b) const
{
  if (a < kFrameCorners) { // its triangles do not go all around
    const Side other = findSide(b, a);
    const int n = triangles_[other.triangle].neighbour[other.index];
    return {n, indexOf(triangles_[n].neighbour, other.triangle)};
  }
  const int start = triangle_of_[a];
  int t = start;
  do {
    const Triangle& triangle = triangles_[t];
    const int i = indexOf(triangle.vertex, a);
    if (triangle.vertex[next(i)] == b)
      return {t, previous(i)};
    t = triangle.neighbour[next(i)];
  } while (t != start);
  return {-1, 0};
}

PlanarTriangulation::Side
PlanarTriangulation::firstCrossing(int a, int b, int& on_segment) const
{
  const LatticePoint& target = point(b);
  const int start = triangle_of_[a];
  int t = start;
  do {
    const Triangle& triangle = triangles_[t];
    const int i = indexOf(triangle.vertex, a);
    const int right = triangle.vertex[next(i)];
    const int side_right = orientation(a, right, target);
    if (side_right == 0 && isAhead(point(a), target, point(right))) {
      on_segment = right;
      return {-1, 0};
    }
    if (side_right > 0 && orientation(a, triangle.vertex[previous(i)], target) < 0)
      return {t, i};
    t = triangle.neighbour[next(i)];
  } while (t != start);
  throw std::domain_error("PlanarTriangulation: a vertex is not surrounded");
}

void
PlanarTriangulation::addConstraint(int a, int b, const EdgeCounts& counts)
{
  std::vector<Constraint> pending = {{a, b, counts}};
  // Rounded crossings may cross again; each time the pieces are shorter.
  std::size_t budget = 4096 * static_cast<std::size_t>(numVertices()) + 65536;
  while (!pending.empty()) {
    if (budget-- == 0)
      throw std::domain_error("PlanarTriangulation: edges cross without end");
    Constraint constraint = pending.back();
    pending.pop_back();
    if (constraint.a == constraint.b)
      continue;
    std::vector<std::pair<int, int>> crossed;
    if (!collectCrossings(constraint, pending, crossed))
      continue;
    flipCrossings(constraint.a, constraint.b, std::move(crossed));
    mark(findSide(constraint.a, constraint.b), constraint.counts);
  }
}

bool
PlanarTriangulation::collectCrossings(Constraint& constraint,
                                      std::vector<Constraint>& pending,
                                      std::vector<std::pair<int, int>>& crossed)
{
  int on_segment = -1;
  Side side = firstCrossing(constraint.a, constraint.b, on_segment);
  while (on_segment < 0) {
    const Triangle& triangle = triangles_[side.triangle];
    if (triangle.fixed[side.index]) {
      splitCrossing(side, constraint, pending);
      return false;
    }
    // The edge runs from the right of the segment to its left.
    const int right = triangle.vertex[next(side.index)];
    const int left = triangle.vertex[previous(side.index)];
    crossed.emplace_back(right, left);
    const int n = triangle.neighbour[side.index];
    const int j = indexOf(triangles_[n].neighbour, side.triangle);
    const int apex = triangles_[n].vertex[j];
    const int where =
        apex == constraint.b ? 0 : orientation(constraint.a, constraint.b, point(apex));
    if (where == 0)
      on_segment = apex;
    // In the neighbour the edge runs left -> right, so next(j) is left.
    side = {n, where > 0 ? next(j) : previous(j)};
  }
  if (on_segment != constraint.b) {
    pending.push_back({on_segment, constraint.b, constraint.counts});
    constraint.b = on_segment;
  }
  return true;
}

void
PlanarTriangulation::splitCrossing(Side side,
                                   const Constraint& constraint,
                                   std::vector<Constraint>& pending)
{
  const Triangle& triangle = triangles_[side.triangle];
  const int p = triangle.vertex[next(side.index)];
  const int q = triangle.vertex[previous(side.index)];
  const EdgeCounts counts = triangle.counts[side.index];
  const int x = addVertex(
      crossingOf(point(constraint.a), point(constraint.b), point(p), point(q)));
  pending.push_back({constraint.a, x, constraint.counts});
  pending.push_back({x, constraint.b, constraint.counts});
  const Side old = findSide(p, q);
  if (old.triangle < 0 || x == p || x == q)
    return; // the vertex fell on p-q and has split it, or is one of its ends
  // Rounding moved the crossing off the edge: the edge gives way and bends.
  mark(old, negated(counts));
  triangles_[old.triangle].fixed[old.index] = false;
  const int n = triangles_[old.triangle].neighbour[old.index];
  triangles_[n].fixed[indexOf(triangles_[n].neighbour, old.triangle)] = false;
  pending.push_back({p, x, counts});
  pending.push_back({x, q, counts});
}

bool
PlanarTriangulation::isConvex(Side side) const
{
  const Triangle& triangle = triangles_[side.triangle];
  const int n = triangle.neighbour[side.index];
  const int a = triangle.vertex[side.index];
  const int d = triangles_[n].vertex[indexOf(triangles_[n].neighbour, side.triangle)];
  return orientation(a, d, point(triangle.vertex[next(side.index)])) < 0 &&
         orientation(a, d, point(triangle.vertex[previous(side.index)])) > 0;
}

void
PlanarTriangulation::flipCrossings(int a,
                                   int b,
                                   std::vector<std::pair<int, int>> crossed)
{
  std::vector<std::pair<int, int>> made;
  for (std::size_t head = 0; head < crossed.size(); ++head) {
    const auto [p, q] = crossed[head];
    const Side side = findSide(p, q);
    if (!isConvex(side)) {
      crossed.emplace_back(p, q); // another flip will make it so
      continue;
    }
    const int n = triangles_[side.triangle].neighbour[side.index];
    const int from = triangles_[side.triangle].vertex[side.index];
    const int to =
        triangles_[n].vertex[indexOf(triangles_[n].neighbour, side.triangle)];
    flip(side);
    const int side_from = from == a || from == b ? 0 : orientation(a, b, point(from));
    const int side_to = to == a || to == b ? 0 : orientation(a, b, point(to));
    if (side_from * side_to < 0)
      crossed.emplace_back(from, to);
    else
      made.emplace_back(from, to);
  }
  std::vector<Side> stack;
  for (const auto& [p, q] : made) {
    const bool is_constraint = (p == a && q == b) || (p == b && q == a);
    const Side side = findSide(p, q);
    if (!is_constraint && side.triangle >= 0)
      stack.push_back(side);
  }
  // The constraint must stand before its surroundings are improved.
  mark(findSide(a, b), EdgeCounts{});
  legalize(stack);
}

} // namespace nurbs
} // namespace pcl
