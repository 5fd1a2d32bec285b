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

/** \brief Copy a net of homogeneous points with its two directions exchanged.
 * \param[in] from \a rows times \a columns points, columns fastest
 * \param[out] to as many points, rows fastest */
inline void
transposeNet(const double* from, Eigen::Index rows, Eigen::Index columns, double* to)
{
  using Points = Eigen::Matrix<double, 4, Eigen::Dynamic>;
  for (Eigen::Index column = 0; column < columns; ++column)
    Eigen::Map<Points>(to + 4 * rows * column, 4, rows) =
        Eigen::Map<const Points, 0, Eigen::OuterStride<>>(
            from + 4 * column, 4, rows, Eigen::OuterStride<>(4 * columns));
}

/** \brief The surface as a spline in one direction. */
inline HomogeneousSpline
toSpline(const NurbsSurface& surface, Direction direction)
{
  const Eigen::Index n_u = surface.numControlPointsU();
  const Eigen::Index n_v = surface.numControlPointsV();
  const double* points = surface.homogeneousPoints().data();
  if (direction == Direction::U)
    return {
        surface.knotsU(), Eigen::Map<const Eigen::MatrixXd>(points, 4 * n_v, n_u), 4};
  HomogeneousSpline spline{surface.knotsV(), Eigen::MatrixXd(4 * n_u, n_v), 4};
  transposeNet(points, n_u, n_v, spline.points.data());
  return spline;
}

/** \brief The surface of a spline in one direction of \a model. */
inline NurbsSurface
toSurface(const HomogeneousSpline& spline,
          const NurbsSurface& model,
          Direction direction)
{
  const Eigen::Index along = spline.points.cols();
  const Eigen::Index across = spline.points.rows() / 4;
  NurbsSurface::HomogeneousPoints points(4, along * across);
  if (direction == Direction::U)
    points = Eigen::Map<const NurbsSurface::HomogeneousPoints>(
        spline.points.data(), 4, points.cols());
  else
    transposeNet(spline.points.data(), along, across, points.data());
  if (!model.isRational())
    points.row(3).setConstant(model.weight(0, 0));
  if (direction == Direction::U)
    return {spline.knots, model.knotsV(), std::move(points)};
  return {model.knotsU(), spline.knots, std::move(points)};
}

} // namespace detail
} // namespace nurbs
} // namespace pcl
