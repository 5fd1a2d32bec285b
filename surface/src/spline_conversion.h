// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "homogeneous_spline.h"

#include <pcl/surface/nurbs/nurbs_curve.h>
#include <pcl/surface/nurbs/nurbs_surface.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace pcl {
namespace nurbs {
namespace detail {

/** \brief Contract check of a public operation. */
inline void
require(bool condition, const char* message)
{
  if (!condition)
    throw std::invalid_argument(std::string("knot operation: ") + message);
}

/** \brief Whether \a u is strictly inside of the domain. */
inline bool
isInside(const KnotVector& knots, double u)
{
  return knots.domainMin() < u && u < knots.domainMax();
}

template <int Dim>
HomogeneousSpline
toSpline(const NurbsCurve<Dim>& curve)
{
  return {curve.knots(), curve.homogeneousPoints(), Dim + 1};
}

/** \brief The curve of a spline; \a model is the curve it was made from. Equal weights
 * stay equal: rounding must not turn a polynomial curve into a rational one. */
template <int Dim>
NurbsCurve<Dim>
toCurve(const HomogeneousSpline& spline, const NurbsCurve<Dim>& model)
{
  typename NurbsCurve<Dim>::HomogeneousPoints points = spline.points;
  if (!model.isRational())
    points.row(Dim).setConstant(model.weight(0));
  return {spline.knots, std::move(points)};
}

/** \brief The surface as a spline in one direction. */
inline HomogeneousSpline
toSpline(const NurbsSurface& surface, Direction direction)
{
  const NurbsSurface turned =
      direction == Direction::U ? surface : surface.transposed();
  const Eigen::Map<const Eigen::MatrixXd> columns(turned.homogeneousPoints().data(),
                                                  4 * turned.numControlPointsV(),
                                                  turned.numControlPointsU());
  return {turned.knotsU(), columns, 4};
}

/** \brief The surface of a spline in one direction of \a model. */
inline NurbsSurface
toSurface(const HomogeneousSpline& spline,
          const NurbsSurface& model,
          Direction direction)
{
  NurbsSurface::HomogeneousPoints points =
      Eigen::Map<const NurbsSurface::HomogeneousPoints>(
          spline.points.data(), 4, spline.points.size() / 4);
  if (!model.isRational())
    points.row(3).setConstant(model.weight(0, 0));
  const bool is_u = direction == Direction::U;
  NurbsSurface surface(
      spline.knots, model.knots(is_u ? Direction::V : Direction::U), std::move(points));
  return is_u ? surface : surface.transposed();
}

} // namespace detail
} // namespace nurbs
} // namespace pcl
