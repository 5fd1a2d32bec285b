// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/differential_geometry.h>

#include "adaptive_quadrature.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace pcl {
namespace nurbs {
namespace {

// The difference of these two rules is the error of the coarse one, so the fine one is
// better than it is judged.
constexpr int kCoarse = 7;
constexpr int kFine = 10;

using Halves = std::array<QuadratureCell, 2>;

Halves
halveU(const QuadratureCell& c)
{
  const double middle = 0.5 * (c.u_min + c.u_max);
  return {{{c.u_min, middle, c.v_min, c.v_max}, {middle, c.u_max, c.v_min, c.v_max}}};
}

Halves
halveV(const QuadratureCell& c)
{
  const double middle = 0.5 * (c.v_min + c.v_max);
  return {{{c.u_min, c.u_max, c.v_min, middle}, {c.u_min, c.u_max, middle, c.v_max}}};
}

template <int Points>
double
areaRule(const NurbsSurface& surface, const QuadratureCell& cell)
{
  return gaussLegendre<Points>(cell.u_min, cell.u_max, [&](double u) {
    return gaussLegendre<Points>(cell.v_min, cell.v_max, [&](double v) {
      const SurfaceJet1 jet = surface.evaluateJet1(u, v);
      return jet.du.cross(jet.dv).norm();
    });
  });
}

/** Halve across the longer of the mid lines. */
Halves
halveLonger(const NurbsSurface& surface, const QuadratureCell& cell)
{
  const SurfaceJet1 middle = surface.evaluateJet1(0.5 * (cell.u_min + cell.u_max),
                                                  0.5 * (cell.v_min + cell.v_max));
  const bool u_longer = middle.du.norm() * (cell.u_max - cell.u_min) >=
                        middle.dv.norm() * (cell.v_max - cell.v_min);
  return u_longer ? halveU(cell) : halveV(cell);
}

template <int Points, int Dim>
double
lengthRule(const NurbsCurve<Dim>& curve, const QuadratureCell& cell)
{
  return gaussLegendre<Points>(cell.u_min, cell.u_max, [&](double u) {
    return curve.derivatives(u, 1)[1].norm();
  });
}

void
requireInDomain(const KnotVector& knots, double u)
{
  if (!(u >= knots.domainMin() && u <= knots.domainMax()))
    throw std::invalid_argument("arcLength: a parameter is outside of the domain");
}

} // namespace

double
surfaceArea(const NurbsSurface& surface, double relative_tolerance)
{
  const std::vector<double> u = surface.knotsU().breaks();
  const std::vector<double> v = surface.knotsV().breaks();
  std::vector<QuadratureCell> cells;
  for (std::size_t i = 0; i + 1 < u.size(); ++i)
    for (std::size_t j = 0; j + 1 < v.size(); ++j)
      cells.push_back({u[i], u[i + 1], v[j], v[j + 1]});
  const auto rule = [&](const QuadratureCell& cell, bool fine) {
    return fine ? areaRule<kFine>(surface, cell) : areaRule<kCoarse>(surface, cell);
  };
  const auto halve = [&](const QuadratureCell& cell) {
    return halveLonger(surface, cell);
  };
  return integrateAdaptively(cells, rule, halve, relative_tolerance);
}

template <int Dim>
double
arcLength(const NurbsCurve<Dim>& curve, double from, double to, double tolerance)
{
  requireInDomain(curve.knots(), from);
  requireInDomain(curve.knots(), to);
  if (to < from)
    return -arcLength(curve, to, from, tolerance);
  std::vector<QuadratureCell> cells;
  const std::vector<double> breaks = curve.knots().breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double low = std::max(breaks[i], from);
    const double high = std::min(breaks[i + 1], to);
    if (low < high)
      cells.push_back({low, high, 0.0, 0.0});
  }
  const auto rule = [&](const QuadratureCell& cell, bool fine) {
    return fine ? lengthRule<kFine>(curve, cell) : lengthRule<kCoarse>(curve, cell);
  };
  return integrateAdaptively(cells, rule, halveU, tolerance);
}

template <int Dim>
double
arcLength(const NurbsCurve<Dim>& curve, double relative_tolerance)
{
  return arcLength(
      curve, curve.knots().domainMin(), curve.knots().domainMax(), relative_tolerance);
}

template double
arcLength<2>(const NurbsCurve<2>&, double, double, double);
template double
arcLength<3>(const NurbsCurve<3>&, double, double, double);
template double
arcLength<2>(const NurbsCurve<2>&, double);
template double
arcLength<3>(const NurbsCurve<3>&, double);

} // namespace nurbs
} // namespace pcl
