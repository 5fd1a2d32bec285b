// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/constructions.h>
#include <pcl/surface/nurbs/knot_operations.h>

#include <Eigen/LU>

#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Chord lengths between sections, each row of control points normalised to a total of
 * 1, averaged over the rows that move at all (equation 10.8). */
std::vector<double>
averagedChordParameters(const std::vector<NurbsCurve3>& sections)
{
  const auto last = static_cast<Eigen::Index>(sections.size()) - 1;
  Eigen::VectorXd steps = Eigen::VectorXd::Zero(last);
  for (int i = 0; i < sections[0].numControlPoints(); ++i) {
    Eigen::VectorXd chords(last);
    for (Eigen::Index k = 0; k < last; ++k)
      chords(k) =
          (sections[k + 1].controlPoint(i) - sections[k].controlPoint(i)).norm();
    if (chords.sum() > 0.0)
      steps += chords / chords.sum();
  }
  if (!(steps.minCoeff() > 0.0))
    throw std::invalid_argument("loftedSurface: neighbouring sections coincide");
  std::vector<double> parameters(sections.size(), 0.0);
  for (Eigen::Index k = 0; k < last; ++k)
    parameters[k + 1] = parameters[k] + steps(k) / steps.sum();
  parameters.back() = 1.0;
  return parameters;
}

/** A common factor of the weights does not change a section, but would change the
 * surface between the sections: make the mean weight 1. */
std::vector<NurbsCurve3>
withMeanWeightOne(const std::vector<NurbsCurve3>& curves)
{
  std::vector<NurbsCurve3> result;
  result.reserve(curves.size());
  for (const NurbsCurve3& curve : curves)
    result.emplace_back(curve.knots(),
                        curve.homogeneousPoints() /
                            curve.homogeneousPoints().row(3).mean());
  return result;
}

void
requireIncreasing(const std::vector<double>& parameters, std::size_t sections)
{
  if (parameters.size() != sections)
    throw std::invalid_argument("loftedSurface: one parameter per section is needed");
  for (std::size_t k = 0; k + 1 < parameters.size(); ++k)
    if (!(parameters[k] < parameters[k + 1]))
      throw std::invalid_argument("loftedSurface: the parameters do not increase");
}

/** Clamped knots by averaging parameters (equation 9.8): every basis function then has
 * a parameter in its support, so that interpolation has one solution. */
KnotVector
averagedKnots(const std::vector<double>& parameters, int degree)
{
  const auto p = static_cast<std::size_t>(degree);
  std::vector<double> knots(p + 1, parameters.front());
  for (std::size_t j = 1; j + p < parameters.size(); ++j) {
    double sum = 0.0;
    for (std::size_t i = j; i < j + p; ++i)
      sum += parameters[i];
    knots.push_back(sum / degree);
  }
  knots.insert(knots.end(), p + 1, parameters.back());
  return {degree, std::move(knots)};
}

/** Row k holds the basis functions at parameter k. */
Eigen::MatrixXd
collocationMatrix(const KnotVector& knots, const std::vector<double>& parameters)
{
  const auto n = static_cast<Eigen::Index>(parameters.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const int span = knots.findSpan(parameters[k]);
    BasisValues basis;
    knots.evaluateBasis(span, parameters[k], basis);
    for (int r = 0; r <= knots.degree(); ++r)
      matrix(k, span - knots.degree() + r) = basis[r];
  }
  return matrix;
}

} // namespace

NurbsSurface
loftedSurface(const std::vector<NurbsCurve3>& sections,
              int degree,
              const std::vector<double>& parameters)
{
  if (degree < 1 || sections.size() < static_cast<std::size_t>(degree) + 1)
    throw std::invalid_argument("loftedSurface: needs at least degree + 1 sections");
  const std::vector<NurbsCurve3> curves = withMeanWeightOne(makeCompatible(sections));
  const std::vector<double> v =
      parameters.empty() ? averagedChordParameters(curves) : parameters;
  requireIncreasing(v, curves.size());
  const KnotVector knots = averagedKnots(v, degree);
  const Eigen::PartialPivLU<Eigen::MatrixXd> solver(collocationMatrix(knots, v));
  const int n = curves[0].numControlPoints();
  const auto count = static_cast<Eigen::Index>(curves.size());
  NurbsSurface::HomogeneousPoints points(4, n * count);
  for (int i = 0; i < n; ++i) {
    Eigen::MatrixX4d row(count, 4);
    for (Eigen::Index k = 0; k < count; ++k)
      row.row(k) = curves[k].homogeneousPoints().col(i).transpose();
    points.middleCols(i * count, count) = solver.solve(row).transpose();
  }
  return {curves[0].knots(), knots, std::move(points)};
}

} // namespace nurbs
} // namespace pcl
