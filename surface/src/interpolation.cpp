// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/interpolation.h>

#include "spline_fit.h"

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

using detail::requireForFit;

/** Length of one step between neighbours. */
double
stepLength(double distance, Parameterization parameterization)
{
  switch (parameterization) {
  case Parameterization::ChordLength:
    return distance;
  case Parameterization::Centripetal:
    return std::sqrt(distance);
  case Parameterization::Uniform:
    break;
  }
  return 1.0;
}

/** Parameters along the columns of \a points; empty if they all coincide. */
std::vector<double>
spreadAlong(const Eigen::Ref<const Eigen::MatrixXd>& points,
            Parameterization parameterization)
{
  requireForFit(points.cols() >= 2, "at least two points are needed");
  requireForFit(points.allFinite(), "a point is not finite");
  std::vector<double> parameters{0.0};
  for (Eigen::Index k = 1; k < points.cols(); ++k)
    parameters.push_back(
        parameters.back() +
        stepLength((points.col(k) - points.col(k - 1)).norm(), parameterization));
  const double total = parameters.back();
  if (!(total > 0.0))
    return {};
  for (double& parameter : parameters)
    parameter /= total;
  return parameters;
}

void
requireGrid(const PointGrid& grid)
{
  requireForFit(grid.count_u > 0 && grid.count_v > 0 &&
                    grid.points.cols() ==
                        static_cast<Eigen::Index>(grid.count_u) * grid.count_v,
                "a grid needs count_u * count_v points");
}

/** The line of a grid that runs along \a direction. */
Eigen::Matrix3Xd
gridLine(const PointGrid& grid, Direction direction, int line)
{
  if (direction == Direction::V)
    return grid.points.middleCols(line * grid.count_v, grid.count_v);
  Eigen::Matrix3Xd points(3, grid.count_u);
  for (int i = 0; i < grid.count_u; ++i)
    points.col(i) = grid.points.col(i * grid.count_v + line);
  return points;
}

/** Points stacked by lines across: from one column of \a b points for each of \a a, to
 * one column of a points for each of b. */
Eigen::MatrixXd
exchanged(const Eigen::MatrixXd& columns)
{
  const Eigen::Index across = columns.rows() / 3;
  Eigen::MatrixXd result(3 * columns.cols(), across);
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    for (Eigen::Index j = 0; j < across; ++j)
      result.block<3, 1>(3 * i, j) = columns.block<3, 1>(3 * j, i);
  return result;
}

/** Fit the lines in u, then the resulting control points in v, each by
 * fit(knots, parameters, columns). */
template <class Fit>
NurbsSurface
fitSeparably(const PointGrid& grid,
             const std::vector<double>& parameters_u,
             const std::vector<double>& parameters_v,
             const KnotVector& knots_u,
             const KnotVector& knots_v,
             const Fit& fit)
{
  requireGrid(grid);
  const Eigen::Map<const Eigen::MatrixXd> lines(
      grid.points.data(), 3 * grid.count_v, grid.count_u);
  const Eigen::MatrixXd in_u = fit(knots_u, parameters_u, lines);
  const Eigen::MatrixXd in_v = fit(knots_v, parameters_v, exchanged(in_u));
  const Eigen::MatrixXd points = exchanged(in_v);
  return NurbsSurface::fromControlPoints(
      knots_u,
      knots_v,
      Eigen::Map<const Eigen::Matrix3Xd>(points.data(), 3, points.size() / 3));
}

} // namespace

template <int Dim>
std::vector<double>
spreadParameters(const PointSequence<Dim>& points, Parameterization parameterization)
{
  std::vector<double> parameters = spreadAlong(points, parameterization);
  requireForFit(!parameters.empty(), "all points coincide");
  return parameters;
}

std::vector<double>
spreadParameters(const PointGrid& grid,
                 Direction direction,
                 Parameterization parameterization)
{
  requireGrid(grid);
  const int lines = direction == Direction::U ? grid.count_v : grid.count_u;
  Eigen::VectorXd sum;
  int used = 0;
  for (int line = 0; line < lines; ++line) {
    const std::vector<double> parameters =
        spreadAlong(gridLine(grid, direction, line), parameterization);
    if (parameters.empty())
      continue;
    const Eigen::Map<const Eigen::VectorXd> values(
        parameters.data(), static_cast<Eigen::Index>(parameters.size()));
    sum = used++ == 0 ? Eigen::VectorXd(values) : Eigen::VectorXd(sum + values);
  }
  requireForFit(used > 0, "the points of every line coincide");
  sum /= used;
  return {sum.data(), sum.data() + sum.size()};
}

KnotVector
interpolationKnots(int degree, const std::vector<double>& parameters)
{
  return approximationKnots(degree, parameters, static_cast<int>(parameters.size()));
}

KnotVector
approximationKnots(int degree,
                   const std::vector<double>& parameters,
                   int control_points)
{
  const int count = static_cast<int>(parameters.size());
  requireForFit(degree >= 1 && degree < control_points && control_points <= count,
                "needs degree < number of control points <= number of points");
  requireForFit(detail::isStrictlyIncreasing(parameters), "parameters do not increase");
  const auto resampled = [&](int k) {
    const auto last = static_cast<std::ptrdiff_t>(control_points) - 1;
    const std::ptrdiff_t scaled = static_cast<std::ptrdiff_t>(k) * (count - 1);
    const auto i = static_cast<std::size_t>(scaled / last);
    const double share = static_cast<double>(scaled % last) / static_cast<double>(last);
    return share == 0.0 ? parameters[i]
                        : (1.0 - share) * parameters[i] + share * parameters[i + 1];
  };
  std::vector<double> breaks{parameters.front()};
  for (int j = 1; j < control_points - degree; ++j) {
    double sum = 0.0;
    for (int k = j; k < j + degree; ++k)
      sum += resampled(k);
    breaks.push_back(sum / degree);
  }
  breaks.push_back(parameters.back());
  return KnotVector::clamped(degree, breaks);
}

template <int Dim>
NurbsCurve<Dim>
interpolateCurve(const PointSequence<Dim>& points,
                 const std::vector<double>& parameters,
                 const KnotVector& knots)
{
  return NurbsCurve<Dim>::fromControlPoints(
      knots, detail::interpolateColumns(knots, parameters, points));
}

template <int Dim>
NurbsCurve<Dim>
interpolateCurve(const PointSequence<Dim>& points,
                 int degree,
                 Parameterization parameterization)
{
  const std::vector<double> parameters =
      spreadParameters<Dim>(points, parameterization);
  return interpolateCurve<Dim>(
      points, parameters, interpolationKnots(degree, parameters));
}

template <int Dim>
NurbsCurve<Dim>
approximateCurve(const PointSequence<Dim>& points,
                 const std::vector<double>& parameters,
                 const KnotVector& knots,
                 const CurveFitOptions& options)
{
  return NurbsCurve<Dim>::fromControlPoints(
      knots,
      detail::fitColumns(knots, parameters, points, options.weights, options.fix_ends));
}

template <int Dim>
NurbsCurve<Dim>
approximateCurve(const PointSequence<Dim>& points,
                 int degree,
                 int control_points,
                 Parameterization parameterization)
{
  const std::vector<double> parameters =
      spreadParameters<Dim>(points, parameterization);
  return approximateCurve<Dim>(
      points, parameters, approximationKnots(degree, parameters, control_points));
}

NurbsSurface
interpolateSurface(const PointGrid& grid,
                   const std::vector<double>& parameters_u,
                   const std::vector<double>& parameters_v,
                   const KnotVector& knots_u,
                   const KnotVector& knots_v)
{
  return fitSeparably(
      grid, parameters_u, parameters_v, knots_u, knots_v, detail::interpolateColumns);
}

NurbsSurface
interpolateSurface(const PointGrid& grid,
                   int degree_u,
                   int degree_v,
                   Parameterization parameterization)
{
  const std::vector<double> u = spreadParameters(grid, Direction::U, parameterization);
  const std::vector<double> v = spreadParameters(grid, Direction::V, parameterization);
  return interpolateSurface(
      grid, u, v, interpolationKnots(degree_u, u), interpolationKnots(degree_v, v));
}

NurbsSurface
approximateSurface(const PointGrid& grid,
                   const std::vector<double>& parameters_u,
                   const std::vector<double>& parameters_v,
                   const KnotVector& knots_u,
                   const KnotVector& knots_v,
                   bool fix_ends)
{
  const auto fit = [fix_ends](const KnotVector& knots,
                              const std::vector<double>& parameters,
                              const Eigen::MatrixXd& data) {
    return detail::fitColumns(knots, parameters, data, Eigen::VectorXd(), fix_ends);
  };
  return fitSeparably(grid, parameters_u, parameters_v, knots_u, knots_v, fit);
}

/// Explicit instances for one dimension of curves.
#define PCL_NURBS_INSTANTIATE(Dim)                                                     \
  template PCL_NURBS_SURFACE_EXPORT std::vector<double> spreadParameters<Dim>(         \
      const PointSequence<Dim>&, Parameterization);                                    \
  template PCL_NURBS_SURFACE_EXPORT NurbsCurve<Dim> interpolateCurve<Dim>(             \
      const PointSequence<Dim>&, const std::vector<double>&, const KnotVector&);       \
  template PCL_NURBS_SURFACE_EXPORT NurbsCurve<Dim> interpolateCurve<Dim>(             \
      const PointSequence<Dim>&, int, Parameterization);                               \
  template PCL_NURBS_SURFACE_EXPORT NurbsCurve<Dim> approximateCurve<Dim>(             \
      const PointSequence<Dim>&,                                                       \
      const std::vector<double>&,                                                      \
      const KnotVector&,                                                               \
      const CurveFitOptions&);                                                         \
  template PCL_NURBS_SURFACE_EXPORT NurbsCurve<Dim> approximateCurve<Dim>(             \
      const PointSequence<Dim>&, int, int, Parameterization);

PCL_NURBS_INSTANTIATE(2)
PCL_NURBS_INSTANTIATE(3)

} // namespace nurbs
} // namespace pcl
