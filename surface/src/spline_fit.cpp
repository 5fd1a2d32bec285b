// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "spline_fit.h"

#include "banded_least_squares.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace pcl {
namespace nurbs {
namespace detail {
namespace {

bool
endsCanBeFixed(const KnotVector& knots, const std::vector<double>& parameters)
{
  return knots.isClamped() && parameters.front() == knots.domainMin() &&
         parameters.back() == knots.domainMax();
}

void
requireFit(const KnotVector& knots,
           const std::vector<double>& parameters,
           const Eigen::Ref<const Eigen::MatrixXd>& data,
           const Eigen::VectorXd& weights)
{
  requireForFit(data.cols() > 0, "there are no points");
  requireForFit(static_cast<Eigen::Index>(parameters.size()) == data.cols(),
                "one parameter per point is needed");
  requireForFit(std::is_sorted(parameters.begin(), parameters.end()),
                "parameters decrease");
  requireForFit(parameters.front() >= knots.domainMin() &&
                    parameters.back() <= knots.domainMax(),
                "a parameter is outside of the domain of the knots");
  requireForFit(data.allFinite(), "a point is not finite");
  requireForFit(weights.size() == 0 || weights.size() == data.cols(),
                "one weight per point is needed");
  requireForFit(weights.size() == 0 ||
                    (weights.allFinite() && weights.minCoeff() > 0.0),
                "weights must be positive and finite");
}

} // namespace

void
requireForFit(bool condition, const char* message)
{
  if (!condition)
    throw std::invalid_argument(std::string("fit of points: ") + message);
}

bool
isStrictlyIncreasing(const std::vector<double>& values)
{
  return std::adjacent_find(values.begin(), values.end(), [](double a, double b) {
           return !(a < b);
         }) == values.end();
}

Eigen::MatrixXd
fitColumns(const KnotVector& knots,
           const std::vector<double>& parameters,
           const Eigen::Ref<const Eigen::MatrixXd>& data,
           const Eigen::VectorXd& weights,
           bool fix_ends)
{
  requireFit(knots, parameters, data, weights);
  requireForFit(!fix_ends || endsCanBeFixed(knots, parameters),
                "fixed ends need clamped knots and parameters from end to end");
  const int p = knots.degree();
  const int count = knots.numControlPoints();
  const int fixed = fix_ends ? 1 : 0; // control columns left out on each side
  const int unknowns = count - 2 * fixed;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(data.rows(), count);
  if (fix_ends) {
    result.col(0) = data.col(0);
    result.col(count - 1) = data.col(data.cols() - 1);
  }
  if (unknowns == 0)
    return result;
  BandedLeastSquares system(unknowns, p + 1, data.rows());
  for (Eigen::Index k = fixed; k < data.cols() - fixed; ++k) {
    const double u = parameters[static_cast<std::size_t>(k)];
    const int span = knots.findSpan(u);
    BasisValues basis;
    knots.evaluateBasis(span, u, basis);
    const Eigen::Map<const Eigen::VectorXd> values(basis.data(), p + 1);
    // Columns not solved for hold either a fixed point or, for all others, zero.
    const Eigen::VectorXd known = result.middleCols(span - p, p + 1) * values;
    const int first = std::max(span - p, fixed);
    const int last = std::min(span, count - 1 - fixed);
    const double scale = weights.size() == 0 ? 1.0 : std::sqrt(weights(k));
    system.add(first - fixed,
               scale * values.segment(first - (span - p), last - first + 1),
               scale * (data.col(k) - known));
  }
  result.middleCols(fixed, unknowns) = system.solve();
  return result;
}

Eigen::MatrixXd
interpolateColumns(const KnotVector& knots,
                   const std::vector<double>& parameters,
                   const Eigen::Ref<const Eigen::MatrixXd>& data)
{
  requireForFit(data.cols() == knots.numControlPoints(),
                "interpolation needs as many control points as points");
  requireForFit(isStrictlyIncreasing(parameters), "parameters do not increase");
  const bool fix_ends = !parameters.empty() && endsCanBeFixed(knots, parameters);
  return fitColumns(knots, parameters, data, Eigen::VectorXd(), fix_ends);
}

} // namespace detail
} // namespace nurbs
} // namespace pcl
