// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/knot_operations.h>

#include "spline_conversion.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

using detail::HomogeneousSpline;
using detail::require;
using detail::SimplifiedSpline;

void
requireTolerance(double tolerance)
{
  require(std::isfinite(tolerance) && tolerance >= 0.0,
          "the tolerance must be finite and not negative");
}

HomogeneousSpline
refine(const HomogeneousSpline& spline, const std::vector<double>& added)
{
  require(std::is_sorted(added.begin(), added.end()), "the new knots decrease");
  for (double u : added) {
    require(u == spline.knots.clampToDomain(u), "a new knot is outside of the domain");
    require(spline.knots.multiplicity(u) + std::count(added.begin(), added.end(), u) <=
                spline.knots.degree(),
            "a knot would get more than degree copies");
  }
  return detail::refined(spline, added);
}

HomogeneousSpline
insert(const HomogeneousSpline& spline, double u, int times)
{
  require(times >= 1, "a knot is inserted at least once");
  return refine(spline, std::vector<double>(static_cast<std::size_t>(times), u));
}

SimplifiedSpline
remove(const HomogeneousSpline& spline, double u, int times, double tolerance)
{
  requireTolerance(tolerance);
  require(times >= 1, "a knot is removed at least once");
  const int copies = spline.knots.multiplicity(u);
  require(copies > 0 && detail::isInside(spline.knots, u),
          "the knot to remove is not an inner knot");
  return detail::withoutKnot(spline, u, std::min(times, copies), tolerance);
}

HomogeneousSpline
elevate(HomogeneousSpline spline, int times)
{
  require(times >= 0 && spline.knots.degree() + times <= kMaxDegree,
          "the degree would leave its range");
  for (int i = 0; i < times; ++i)
    spline = detail::elevated(spline);
  return spline;
}

SimplifiedSpline
reduce(const HomogeneousSpline& spline, double tolerance)
{
  requireTolerance(tolerance);
  require(spline.knots.degree() > 1, "degree 1 cannot be reduced");
  return detail::reduced(spline, tolerance);
}

template <int Dim>
Simplified<NurbsCurve<Dim>>
simplified(const SimplifiedSpline& result, const NurbsCurve<Dim>& model)
{
  if (result.steps == 0)
    return {model, 0, 0.0};
  return {detail::toCurve(result.spline, model), result.steps, result.max_error};
}

Simplified<NurbsSurface>
simplified(const SimplifiedSpline& result,
           const NurbsSurface& model,
           Direction direction)
{
  if (result.steps == 0)
    return {model, 0, 0.0};
  return {detail::toSurface(result.spline, model, direction),
          result.steps,
          result.max_error};
}

} // namespace

template <int Dim>
NurbsCurve<Dim>
insertKnot(const NurbsCurve<Dim>& curve, double u, int times)
{
  return toCurve(insert(detail::toSpline(curve), u, times), curve);
}

NurbsSurface
insertKnot(const NurbsSurface& surface, Direction direction, double u, int times)
{
  return toSurface(
      insert(detail::toSpline(surface, direction), u, times), surface, direction);
}

template <int Dim>
NurbsCurve<Dim>
refineKnots(const NurbsCurve<Dim>& curve, const std::vector<double>& knots)
{
  return toCurve(refine(detail::toSpline(curve), knots), curve);
}

NurbsSurface
refineKnots(const NurbsSurface& surface,
            Direction direction,
            const std::vector<double>& knots)
{
  return toSurface(
      refine(detail::toSpline(surface, direction), knots), surface, direction);
}

template <int Dim>
Simplified<NurbsCurve<Dim>>
removeKnot(const NurbsCurve<Dim>& curve, double u, int times, double tolerance)
{
  return simplified(remove(detail::toSpline(curve), u, times, tolerance), curve);
}

Simplified<NurbsSurface>
removeKnot(const NurbsSurface& surface,
           Direction direction,
           double u,
           int times,
           double tolerance)
{
  return simplified(remove(detail::toSpline(surface, direction), u, times, tolerance),
                    surface,
                    direction);
}

template <int Dim>
Simplified<NurbsCurve<Dim>>
removeRedundantKnots(const NurbsCurve<Dim>& curve, double tolerance)
{
  requireTolerance(tolerance);
  return simplified(detail::withoutRedundantKnots(detail::toSpline(curve), tolerance),
                    curve);
}

Simplified<NurbsSurface>
removeRedundantKnots(const NurbsSurface& surface, double tolerance)
{
  requireTolerance(tolerance);
  const auto along = [](const NurbsSurface& s, Direction direction, double budget) {
    return simplified(
        detail::withoutRedundantKnots(detail::toSpline(s, direction), budget),
        s,
        direction);
  };
  const Simplified<NurbsSurface> u = along(surface, Direction::U, 0.5 * tolerance);
  const Simplified<NurbsSurface> v =
      along(u.geometry, Direction::V, tolerance - u.max_error);
  return {v.geometry, u.steps + v.steps, u.max_error + v.max_error};
}

template <int Dim>
NurbsCurve<Dim>
elevateDegree(const NurbsCurve<Dim>& curve, int times)
{
  return toCurve(elevate(detail::toSpline(curve), times), curve);
}

NurbsSurface
elevateDegree(const NurbsSurface& surface, Direction direction, int times)
{
  return toSurface(
      elevate(detail::toSpline(surface, direction), times), surface, direction);
}

template <int Dim>
Simplified<NurbsCurve<Dim>>
reduceDegree(const NurbsCurve<Dim>& curve, double tolerance)
{
  return simplified(reduce(detail::toSpline(curve), tolerance), curve);
}

Simplified<NurbsSurface>
reduceDegree(const NurbsSurface& surface, Direction direction, double tolerance)
{
  return simplified(
      reduce(detail::toSpline(surface, direction), tolerance), surface, direction);
}

/// Explicit instances for one dimension of curves.
#define PCL_NURBS_INSTANTIATE(Dim)                                                     \
  template PCL_NURBS_SURFACE_EXPORT NurbsCurve<Dim> insertKnot(                        \
      const NurbsCurve<Dim>&, double, int);                                            \
  template PCL_NURBS_SURFACE_EXPORT NurbsCurve<Dim> refineKnots(                       \
      const NurbsCurve<Dim>&, const std::vector<double>&);                             \
  template PCL_NURBS_SURFACE_EXPORT Simplified<NurbsCurve<Dim>> removeKnot(            \
      const NurbsCurve<Dim>&, double, int, double);                                    \
  template PCL_NURBS_SURFACE_EXPORT Simplified<NurbsCurve<Dim>> removeRedundantKnots(  \
      const NurbsCurve<Dim>&, double);                                                 \
  template PCL_NURBS_SURFACE_EXPORT NurbsCurve<Dim> elevateDegree(                     \
      const NurbsCurve<Dim>&, int);                                                    \
  template PCL_NURBS_SURFACE_EXPORT Simplified<NurbsCurve<Dim>> reduceDegree(          \
      const NurbsCurve<Dim>&, double);

PCL_NURBS_INSTANTIATE(2)
PCL_NURBS_INSTANTIATE(3)

} // namespace nurbs
} // namespace pcl
