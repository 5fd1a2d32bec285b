// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "planar_triangulation.h"

#include <algorithm>

namespace pcl {
namespace nurbs {
namespace {

__extension__ typedef __int128 Wide;

std::uint64_t
keyOf(const LatticePoint& point)
{
  // Corners of the frame are at -kResolution; the shift makes both parts non-negative.
  const auto part = [](std::int64_t c) {
    return static_cast<std::uint64_t>(c + PlanarTriangulation::kResolution);
  };
  return part(point.x) << 32U | part(point.y);
}

} // namespace

PlanarTriangulation::PlanarTriangulation()
{
  // A frame well outside of the rectangle.
  constexpr std::int64_t low = -kResolution / 2;
  constexpr std::int64_t high = kResolution + kResolution / 2;
  points_ = {{low, low}, {high, low}, {high, high}, {low, high}};
  triangle_of_ = {0, 0, 0, 1};
  triangles_ = {{{0, 1, 2}, {-1, 1, -1}}, {{0, 2, 3}, {-1, -1, 0}}};
}

int
PlanarTriangulation::orientation(int a, int b, const LatticePoint& c) const
{
  const LatticePoint& p = point(a);
  const LatticePoint& q = point(b);
  const std::int64_t det = (q.x - p.x) * (c.y - p.y) - (q.y - p.y) * (c.x - p.x);
  return (det > 0) - (det < 0);
}

bool
PlanarTriangulation::isInCircle(const Triangle& triangle, int vertex) const
{
  const LatticePoint& d = point(vertex);
  std::array<std::int64_t, 3> x, y, lift;
  for (int i = 0; i < 3; ++i) {
    x[i] = point(triangle.vertex[i]).x - d.x;
    y[i] = point(triangle.vertex[i]).y - d.y;
    lift[i] = x[i] * x[i] + y[i] * y[i];
  }
  Wide det = 0;
  for (int i = 0; i < 3; ++i)
    det += Wide{lift[i]} * (x[next(i)] * y[previous(i)] - x[previous(i)] * y[next(i)]);
  return det > 0;
}

int
PlanarTriangulation::locate(const LatticePoint& point) const
{
  const auto outwardSide = [&](int t) {
    const Triangle& triangle = triangles_[t];
    for (int i = 0; i < 3; ++i)
      if (orientation(triangle.vertex[next(i)], triangle.vertex[previous(i)], point) <
          0)
        return i;
    return -1;
  };
  // The walk ends in a Delaunay triangulation; constraints might send it in circles.
  for (std::size_t steps = triangles_.size(); steps > 0; --steps) {
    const int i = outwardSide(last_);
    if (i < 0)
      return last_;
    last_ = triangles_[last_].neighbour[i];
  }
  last_ = 0;
  while (outwardSide(last_) >= 0)
    ++last_;
  return last_;
}

void
PlanarTriangulation::link(Side a, Side b)
{
  if (a.triangle >= 0)
    triangles_[a.triangle].neighbour[a.index] = b.triangle;
  if (b.triangle >= 0)
    triangles_[b.triangle].neighbour[b.index] = a.triangle;
}

void
PlanarTriangulation::relink(Side from, Side to)
{
  const Triangle& source = triangles_[from.triangle];
  const int other = source.neighbour[from.index];
  triangles_[to.triangle].counts[to.index] = source.counts[from.index];
  triangles_[to.triangle].fixed[to.index] = source.fixed[from.index];
  triangles_[to.triangle].neighbour[to.index] = other;
  if (other >= 0)
    triangles_[other].neighbour[indexOf(triangles_[other].neighbour, from.triangle)] =
        to.triangle;
}

int
PlanarTriangulation::addVertex(const LatticePoint& point)
{
  const int vertex = numVertices();
  const auto [known, is_new] = vertex_at_.emplace(keyOf(point), vertex);
  if (!is_new)
    return known->second;
  const int t = locate(point);
  points_.push_back(point);
  triangle_of_.push_back(t);
  int border = -1;
  for (int i = 0; i < 3; ++i)
    if (orientation(triangles_[t].vertex[next(i)],
                    triangles_[t].vertex[previous(i)],
                    point) == 0)
      border = i;
  if (border < 0)
    splitTriangle(t, vertex);
  else
    splitSide({t, border}, vertex);
  return vertex;
}

void
PlanarTriangulation::splitTriangle(int triangle, int vertex)
{
  const auto [a, b, c] = triangles_[triangle].vertex;
  const int second = static_cast<int>(triangles_.size());
  const int third = second + 1;
  triangles_.push_back({{vertex, c, a}, {-1, -1, -1}});
  triangles_.push_back({{vertex, a, b}, {-1, -1, -1}});
  relink({triangle, 1}, {second, 0});
  relink({triangle, 2}, {third, 0});
  Triangle& first = triangles_[triangle];
  const Triangle old = first;
  first = {{vertex, b, c}, {old.neighbour[0], -1, -1}};
  first.counts[0] = old.counts[0];
  first.fixed[0] = old.fixed[0];
  link({triangle, 1}, {second, 2});
  link({second, 1}, {third, 2});
  link({third, 1}, {triangle, 2});
  triangle_of_[a] = second;
  triangle_of_[b] = triangle;
  triangle_of_[c] = triangle;
  triangle_of_[vertex] = triangle;
  std::vector<Side> stack = {{triangle, 0}, {second, 0}, {third, 0}};
  legalize(stack);
}

void
PlanarTriangulation::splitSide(Side side, int vertex)
{
  // Triangles (a, b, c) and (d, c, b) share the edge b-c that the vertex halves.
  const int i = side.index;
  const int t = side.triangle;
  const int n = triangles_[t].neighbour[i];
  const int j = indexOf(triangles_[n].neighbour, t);
  const int a = triangles_[t].vertex[i];
  const int b = triangles_[t].vertex[next(i)];
  const int c = triangles_[t].vertex[previous(i)];
  const int d = triangles_[n].vertex[j];
  const EdgeCounts counts = triangles_[t].counts[i];
  const bool fixed = triangles_[t].fixed[i];
  const int t2 = static_cast<int>(triangles_.size());
  const int n2 = t2 + 1;
  triangles_.push_back({{vertex, c, a}, {-1, -1, -1}});
  triangles_.push_back({{vertex, b, d}, {-1, -1, -1}});
  relink({t, next(i)}, {t2, 0});
  relink({n, next(j)}, {n2, 0});
  const auto rebuild = [&](int triangle, int old_side, int p, int q) {
    const Triangle old = triangles_[triangle];
    Triangle& now = triangles_[triangle];
    now = {{vertex, p, q}, {old.neighbour[old_side], -1, -1}};
    now.counts[0] = old.counts[old_side];
    now.fixed[0] = old.fixed[old_side];
  };
  rebuild(t, previous(i), a, b);
  rebuild(n, previous(j), d, c);
  link({t, 2}, {t2, 1});
  link({n, 2}, {n2, 1});
  link({t, 1}, {n2, 2});
  link({t2, 2}, {n, 1});
  triangle_of_[vertex] = t;
  triangle_of_[a] = t;
  triangle_of_[b] = t;
  triangle_of_[c] = n;
  triangle_of_[d] = n;
  if (fixed) {
    mark({t, 1}, counts);
    mark({t2, 2}, counts);
  }
  std::vector<Side> stack = {{t, 0}, {n, 0}, {t2, 0}, {n2, 0}};
  legalize(stack);
}

void
PlanarTriangulation::flip(Side side)
{
  // (a, b, c) and (d, c, b) become (a, b, d) and (d, c, a).
  const int t = side.triangle;
  const int i = side.index;
  const int n = triangles_[t].neighbour[i];
  const int j = indexOf(triangles_[n].neighbour, t);
  const Triangle first = triangles_[t];
  const Triangle second = triangles_[n];
  const int a = first.vertex[i];
  const int b = first.vertex[next(i)];
  const int c = first.vertex[previous(i)];
  const int d = second.vertex[j];
  const auto outer = [](Triangle& to, int index, const Triangle& from, int side_index) {
    to.neighbour[index] = from.neighbour[side_index];
    to.counts[index] = from.counts[side_index];
    to.fixed[index] = from.fixed[side_index];
  };
  Triangle& left = triangles_[t];
  Triangle& right = triangles_[n];
  left = {{a, b, d}, {-1, n, -1}};
  right = {{d, c, a}, {-1, t, -1}};
  outer(left, 0, second, next(j));      // b-d lies opposite of c in (d, c, b)
  outer(left, 2, first, previous(i));   // a-b lies opposite of c
  outer(right, 0, first, next(i));      // c-a lies opposite of b
  outer(right, 2, second, previous(j)); // d-c lies opposite of b
  const auto rename = [this](int neighbour, int from, int to) {
    if (neighbour >= 0)
      triangles_[neighbour].neighbour[indexOf(triangles_[neighbour].neighbour, from)] =
          to;
  };
  rename(left.neighbour[0], n, t);
  rename(right.neighbour[0], t, n);
  triangle_of_[a] = triangle_of_[b] = triangle_of_[d] = t;
  triangle_of_[c] = n;
}

void
PlanarTriangulation::legalize(std::vector<Side>& stack)
{
  while (!stack.empty()) {
    const Side side = stack.back();
    stack.pop_back();
    const Triangle& triangle = triangles_[side.triangle];
    const int n = triangle.neighbour[side.index];
    if (n < 0 || triangle.fixed[side.index])
      continue;
    const int opposite =
        triangles_[n].vertex[indexOf(triangles_[n].neighbour, side.triangle)];
    if (!isInCircle(triangle, opposite))
      continue;
    flip(side);
    stack.push_back({side.triangle, 0});
    stack.push_back({side.triangle, 2});
    stack.push_back({n, 0});
    stack.push_back({n, 2});
  }
}

std::vector<PlanarTriangulation::LabelledTriangle>
PlanarTriangulation::labelledTriangles() const
{
  std::vector<EdgeCounts> windings(triangles_.size());
  std::vector<bool> known(triangles_.size(), false);
  std::vector<int> stack = {triangle_of_[0]}; // at the frame, outside of all regions
  known[static_cast<std::size_t>(stack.front())] = true;
  std::vector<LabelledTriangle> result;
  while (!stack.empty()) {
    const int t = stack.back();
    stack.pop_back();
    const Triangle& triangle = triangles_[t];
    if (windings[t][0] != 0 || windings[t][1] != 0)
      result.push_back({triangle.vertex, windings[t]});
    for (int i = 0; i < 3; ++i) {
      const int n = triangle.neighbour[i];
      if (n < 0 || known[n])
        continue;
      known[n] = true;
      for (std::size_t k = 0; k < windings[n].size(); ++k)
        windings[n][k] = windings[t][k] - triangle.counts[i][k];
      stack.push_back(n);
    }
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
