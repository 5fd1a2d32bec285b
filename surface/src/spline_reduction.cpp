// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "banded_least_squares.h"
#include "homogeneous_spline.h"

#include <algorithm>
#include <iterator>

namespace pcl {
namespace nurbs {
namespace detail {
namespace {

/** Clamped knots of one degree less: one copy less of every inner knot that has more
 * than one (its continuity stays), simple knots stay simple (they gain a kink one
 * derivative lower, without which nothing but single polynomials could be met). */
KnotVector
reducedKnots(const KnotVector& knots)
{
  const std::vector<double> breaks = knots.breaks();
  std::vector<double> result;
  for (double u : breaks) {
    const int copies = u == breaks.front() || u == breaks.back()
                           ? knots.degree()
                           : std::max(1, knots.multiplicity(u) - 1);
    result.insert(result.end(), static_cast<std::size_t>(copies), u);
  }
  return {knots.degree() - 1, std::move(result)};
}

/** Coefficients of one row of the system: first unknown and values. */
struct BandRow {
  Eigen::Index first;
  Eigen::VectorXd values;
};

/** The part of \a column between its first and last non-zero. */
BandRow
bandRow(const Eigen::VectorXd& column)
{
  Eigen::Index first = 0;
  Eigen::Index last = column.size() - 1;
  while (first < last && column(first) == 0.0)
    ++first;
  while (last > first && column(last) == 0.0)
    --last;
  return {first, column.segment(first, last - first + 1)};
}

/** Columns x with elevation^T x ~ target in the least-squares sense; the first and last
 * column are given, so that the ends of the curve stay. */
Eigen::MatrixXd
solveWithFixedEnds(const Eigen::MatrixXd& elevation, const Eigen::MatrixXd& target)
{
  const Eigen::Index count = elevation.rows();
  Eigen::MatrixXd x(target.rows(), count);
  x.col(0) = target.col(0);
  x.col(count - 1) = target.col(target.cols() - 1);
  if (count == 2)
    return x;
  const Eigen::MatrixXd inner = elevation.middleRows(1, count - 2);
  const Eigen::MatrixXd right = target - x.col(0) * elevation.row(0) -
                                x.col(count - 1) * elevation.row(count - 1);
  std::vector<BandRow> rows;
  Eigen::Index bandwidth = 1;
  for (Eigen::Index k = 0; k < inner.cols(); ++k) {
    rows.push_back(bandRow(inner.col(k)));
    bandwidth = std::max(bandwidth, rows.back().values.size());
  }
  BandedLeastSquares system(count - 2, bandwidth, target.rows());
  for (std::size_t k = 0; k < rows.size(); ++k)
    system.add(rows[k].first, rows[k].values, right.col(static_cast<Eigen::Index>(k)));
  x.middleCols(1, count - 2) = system.solve();
  return x;
}

/** Knots that cut every span into 2 p equal parts. */
std::vector<double>
evenlyWithinSpans(const KnotVector& knots)
{
  const std::vector<double> breaks = knots.breaks();
  const int parts = 2 * knots.degree();
  std::vector<double> inner;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int k = 1; k < parts; ++k)
      inner.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / parts);
  return inner;
}

} // namespace

SimplifiedSpline
reduced(const HomogeneousSpline& input, double tolerance)
{
  const HomogeneousSpline spline =
      restricted(input, input.knots.domainMin(), input.knots.domainMax());
  const KnotVector knots = reducedKnots(spline.knots);
  const int count = knots.numControlPoints();

  // The reduced curve, raised again, and the given one share the knots of the former:
  // there their control points can be compared. Raising is linear in the points.
  const HomogeneousSpline raising =
      elevated({knots, Eigen::MatrixXd::Identity(count, count), 1});
  const std::vector<double>& common = raising.knots.values();
  const std::vector<double>& given = spline.knots.values();
  std::vector<double> added;
  std::set_difference(common.begin(),
                      common.end(),
                      given.begin(),
                      given.end(),
                      std::back_inserter(added));
  const Eigen::MatrixXd target = refined(spline, added).points;
  Eigen::MatrixXd points = solveWithFixedEnds(raising.points, target);
  // Defects of opposite sign alternate; on finer knots their hull is much tighter.
  const HomogeneousSpline defect =
      refined({raising.knots, points * raising.points - target, spline.point_rows},
              evenlyWithinSpans(raising.knots));
  const double error = deviationBound(
      defect.points, target, leastWeight(points, spline.point_rows), spline.point_rows);
  if (!(error <= tolerance))
    return {input, 0, 0.0};
  return {{knots, std::move(points), spline.point_rows}, 1, error};
}

} // namespace detail
} // namespace nurbs
} // namespace pcl
