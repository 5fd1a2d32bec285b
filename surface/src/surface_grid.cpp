// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "surface_grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

// Triangles beside trimming curves reach over more than one cell, so cells get half.
constexpr double kShareOfTolerance = 0.5;
constexpr double kMaxGridPoints = 1 << 24;

/** Bounds over one knot span pair, for the span's full length in u and v. */
struct SpanBounds {
  double uu = 0.0, uv = 0.0, vv = 0.0; // |normal . second difference| / 8
  double edge_u = 0.0, edge_v = 0.0;   // length of the sides
};

void
include(const NurbsSurface& surface,
        double u,
        double v,
        double length_u,
        double length_v,
        SpanBounds& bounds)
{
  const SurfaceJet2 jet = surface.evaluateJet2(u, v);
  Eigen::Vector3d normal = jet.du.cross(jet.dv);
  const auto bend = [&](const Eigen::Vector3d& derivative) {
    // Without a normal (a pole) the whole vector counts.
    return normal.isZero() ? derivative.norm() : std::abs(normal.dot(derivative));
  };
  if (normal.norm() > 1e-9 * jet.du.norm() * jet.dv.norm())
    normal.normalize();
  else
    normal.setZero();
  bounds.uu = std::max(bounds.uu, bend(jet.duu) * length_u * length_u / 8.0);
  bounds.uv = std::max(bounds.uv, bend(jet.duv) * length_u * length_v / 4.0);
  bounds.vv = std::max(bounds.vv, bend(jet.dvv) * length_v * length_v / 8.0);
  bounds.edge_u = std::max(bounds.edge_u, jet.du.norm() * length_u);
  bounds.edge_v = std::max(bounds.edge_v, jet.dv.norm() * length_v);
}

std::vector<SpanBounds>
boundsOf(const NurbsSurface& surface,
         const std::vector<double>& u,
         const std::vector<double>& v)
{
  const std::size_t spans = std::max(u.size(), v.size()) - 1;
  const std::size_t probes = spans <= 8 ? 6 : spans <= 64 ? 3 : 2;
  std::vector<SpanBounds> bounds((u.size() - 1) * (v.size() - 1));
  for (std::size_t i = 0; i + 1 < u.size(); ++i)
    for (std::size_t j = 0; j + 1 < v.size(); ++j)
      for (std::size_t k = 0; k < probes * probes; ++k) {
        const auto at = [&](double first, double last, std::size_t step) {
          // Just inside of the ends, where a higher derivative may jump.
          const double f = static_cast<double>(step) / static_cast<double>(probes - 1);
          return first + (0.01 + 0.98 * f) * (last - first);
        };
        include(surface,
                at(u[i], u[i + 1], k / probes),
                at(v[j], v[j + 1], k % probes),
                u[i + 1] - u[i],
                v[j + 1] - v[j],
                bounds[i * (v.size() - 1) + j]);
      }
  return bounds;
}

/** Smallest counts of parts per span for which every cell is flat enough. */
void
chooseParts(const std::vector<SpanBounds>& bounds,
            const TessellationOptions& options,
            std::vector<double>& parts_u,
            std::vector<double>& parts_v)
{
  const double tolerance = kShareOfTolerance * options.chord_tolerance;
  const double longest =
      options.max_edge_length > 0.0 ? options.max_edge_length : HUGE_VAL;
  constexpr double kGrowth = 1.2;
  for (std::size_t i = 0; i < parts_u.size(); ++i)
    for (std::size_t j = 0; j < parts_v.size(); ++j) {
      const SpanBounds& b = bounds[i * parts_v.size() + j];
      double& m = parts_u[i];
      double& n = parts_v[j];
      m = std::max(m, b.edge_u / longest);
      n = std::max(n, b.edge_v / longest);
      while (b.uu / (m * m) + b.uv / (m * n) + b.vv / (n * n) > tolerance &&
             m * n <= kMaxGridPoints)
        (b.uu / (m * m) > b.vv / (n * n) || (b.uu == b.vv && m < n) ? m : n) *= kGrowth;
    }
}

std::vector<double>
cut(const std::vector<double>& breaks, const std::vector<double>& parts)
{
  std::vector<double> lines;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double count = std::ceil(parts[i] - 1e-9);
    for (double k = 0.0; k < count; k += 1.0)
      lines.push_back(breaks[i] + k / count * (breaks[i + 1] - breaks[i]));
  }
  lines.push_back(breaks.back());
  return lines;
}

double
sum(const std::vector<double>& values)
{
  double total = 0.0;
  for (const double value : values)
    total += std::ceil(value);
  return total;
}

double
cellCoordinate(const std::vector<double>& lines, double t)
{
  const auto above = std::upper_bound(lines.begin() + 1, lines.end() - 1, t);
  const double low = *(above - 1);
  return static_cast<double>(above - 1 - lines.begin()) + (t - low) / (*above - low);
}

} // namespace

SurfaceGrid::SurfaceGrid(const NurbsSurface& surface,
                         const TessellationOptions& options)
{
  const std::vector<double> breaks_u = surface.knotsU().breaks();
  const std::vector<double> breaks_v = surface.knotsV().breaks();
  const std::vector<SpanBounds> bounds = boundsOf(surface, breaks_u, breaks_v);
  std::vector<double> parts_u(breaks_u.size() - 1, 1.0);
  std::vector<double> parts_v(breaks_v.size() - 1, 1.0);
  chooseParts(bounds, options, parts_u, parts_v);
  if (!(sum(parts_u) * sum(parts_v) <= kMaxGridPoints))
    throw std::domain_error("tessellate: the tolerance is too small for the surface");
  u_ = cut(breaks_u, parts_u);
  v_ = cut(breaks_v, parts_v);
  Eigen::Vector2d lengths = Eigen::Vector2d::Zero();
  for (const SpanBounds& b : bounds)
    lengths += Eigen::Vector2d(b.edge_u / static_cast<double>(parts_v.size()),
                               b.edge_v / static_cast<double>(parts_u.size()));
  scale_ = {lengths.x() / surface.knotsU().domainLength(),
            lengths.y() / surface.knotsV().domainLength()};
}

Eigen::Vector2d
SurfaceGrid::cellCoordinates(const Eigen::Vector2d& uv) const
{
  return {cellCoordinate(u_, uv.x()), cellCoordinate(v_, uv.y())};
}

} // namespace nurbs
} // namespace pcl
