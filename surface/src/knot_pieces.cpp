// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/knot_operations.h>

#include "spline_conversion.h"

namespace pcl {
namespace nurbs {
namespace {

using detail::HomogeneousSpline;

HomogeneousSpline
clamp(const HomogeneousSpline& spline)
{
  return detail::restricted(spline, spline.knots.domainMin(), spline.knots.domainMax());
}

std::pair<HomogeneousSpline, HomogeneousSpline>
splitInside(const HomogeneousSpline& spline, double u)
{
  detail::require(detail::isInside(spline.knots, u),
                  "the parameter is not inside of the domain");
  return detail::splitAt(spline, u);
}

HomogeneousSpline restrict(const HomogeneousSpline& spline, double first, double last)
{
  detail::require(spline.knots.domainMin() <= first && first < last &&
                      last <= spline.knots.domainMax(),
                  "the part is empty or leaves the domain");
  return detail::restricted(spline, first, last);
}

} // namespace

template <int Dim>
NurbsCurve<Dim>
clampKnots(const NurbsCurve<Dim>& curve)
{
  return toCurve(clamp(detail::toSpline(curve)), curve);
}

NurbsSurface
clampKnots(const NurbsSurface& surface, Direction direction)
{
  return toSurface(clamp(detail::toSpline(surface, direction)), surface, direction);
}

template <int Dim>
std::pair<NurbsCurve<Dim>, NurbsCurve<Dim>>
split(const NurbsCurve<Dim>& curve, double u)
{
  const auto parts = splitInside(detail::toSpline(curve), u);
  return {toCurve(parts.first, curve), toCurve(parts.second, curve)};
}

std::pair<NurbsSurface, NurbsSurface>
split(const NurbsSurface& surface, Direction direction, double parameter)
{
  const auto parts = splitInside(detail::toSpline(surface, direction), parameter);
  return {toSurface(parts.first, surface, direction),
          toSurface(parts.second, surface, direction)};
}

template <int Dim>
NurbsCurve<Dim>
subCurve(const NurbsCurve<Dim>& curve, double u0, double u1)
{
  return toCurve(restrict(detail::toSpline(curve), u0, u1), curve);
}

NurbsSurface
subSurface(const NurbsSurface& surface, double u0, double u1, double v0, double v1)
{
  const NurbsSurface strip = toSurface(
      restrict(detail::toSpline(surface, Direction::U), u0, u1), surface, Direction::U);
  return toSurface(
      restrict(detail::toSpline(strip, Direction::V), v0, v1), strip, Direction::V);
}

template <int Dim>
std::vector<NurbsCurve<Dim>>
decomposeBezier(const NurbsCurve<Dim>& curve)
{
  std::vector<NurbsCurve<Dim>> pieces;
  for (const HomogeneousSpline& piece : detail::bezierPieces(detail::toSpline(curve)))
    pieces.push_back(toCurve(piece, curve));
  return pieces;
}

std::vector<NurbsSurface>
decomposeBezier(const NurbsSurface& surface)
{
  std::vector<NurbsSurface> patches;
  for (const auto& in_u :
       detail::bezierPieces(detail::toSpline(surface, Direction::U))) {
    const NurbsSurface strip = toSurface(in_u, surface, Direction::U);
    for (const auto& in_v : detail::bezierPieces(detail::toSpline(strip, Direction::V)))
      patches.push_back(toSurface(in_v, strip, Direction::V));
  }
  return patches;
}

/// Explicit instances for one dimension of curves.
#define PCL_NURBS_INSTANTIATE(Dim)                                                     \
  template PCL_NURBS_SURFACE_EXPORT NurbsCurve<Dim> clampKnots(                        \
      const NurbsCurve<Dim>&);                                                         \
  template PCL_NURBS_SURFACE_EXPORT std::pair<NurbsCurve<Dim>, NurbsCurve<Dim>> split( \
      const NurbsCurve<Dim>&, double);                                                 \
  template PCL_NURBS_SURFACE_EXPORT NurbsCurve<Dim> subCurve(                          \
      const NurbsCurve<Dim>&, double, double);                                         \
  template PCL_NURBS_SURFACE_EXPORT std::vector<NurbsCurve<Dim>> decomposeBezier(      \
      const NurbsCurve<Dim>&);

PCL_NURBS_INSTANTIATE(2)
PCL_NURBS_INSTANTIATE(3)

} // namespace nurbs
} // namespace pcl
