// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "homogeneous_spline.h"

#include <pcl/surface/nurbs/runtime_simd.h>

#include <algorithm>
#include <cstddef>

namespace pcl {
namespace nurbs {
namespace detail {
namespace {

/** values = ratio * next + (1 - ratio) * values. */
PCL_NURBS_RUNTIME_SIMD void
blend(double ratio, const double* next, double* values, std::ptrdiff_t count)
{
  for (std::ptrdiff_t i = 0; i < count; ++i)
    values[i] = ratio * next[i] + (1.0 - ratio) * values[i];
}

/** Knots [begin, end) and the control points that belong to them. */
HomogeneousSpline
slice(const HomogeneousSpline& spline, std::ptrdiff_t begin, std::ptrdiff_t end)
{
  const auto first = spline.knots.values().begin();
  const int degree = spline.knots.degree();
  return {KnotVector(degree, std::vector<double>(first + begin, first + end)),
          spline.points.middleCols(begin, end - begin - degree - 1),
          spline.point_rows};
}

std::ptrdiff_t
firstCopy(const KnotVector& knots, double u)
{
  const std::vector<double>& values = knots.values();
  return std::lower_bound(values.begin(), values.end(), u) - values.begin();
}

std::ptrdiff_t
behindLastCopy(const KnotVector& knots, double u)
{
  const std::vector<double>& values = knots.values();
  return std::upper_bound(values.begin(), values.end(), u) - values.begin();
}

/** Insert sorted distinct parameters until each has degree + 1 copies. */
HomogeneousSpline
withJumpsAt(const HomogeneousSpline& spline, const std::vector<double>& parameters)
{
  std::vector<double> added;
  for (double u : parameters) {
    const int missing = spline.knots.degree() + 1 - spline.knots.multiplicity(u);
    added.insert(added.end(), static_cast<std::size_t>(missing), u);
  }
  return refined(spline, added);
}

} // namespace

HomogeneousSpline
refined(const HomogeneousSpline& spline, const std::vector<double>& added)
{
  if (added.empty())
    return spline;
  const int p = spline.knots.degree();
  const std::vector<double>& old = spline.knots.values();
  const auto count = static_cast<std::ptrdiff_t>(added.size());
  const std::ptrdiff_t first_span = spline.knots.findSpan(added.front());
  std::vector<double> knots(old.size() + added.size());
  Eigen::MatrixXd points(spline.points.rows(), spline.points.cols() + count);

  // From the right: old knots and points move by the number of knots still to insert;
  // then the new knot blends the p points whose support it cuts.
  auto i = static_cast<std::ptrdiff_t>(old.size()) - 1;
  std::ptrdiff_t k = i + count;
  for (auto u = added.rbegin(); u != added.rend(); ++u, --k) {
    for (; i > first_span && old[i] >= *u; --i, --k) {
      knots[k] = old[i];
      points.col(k - p - 1) = spline.points.col(i - p - 1);
    }
    points.col(k - p - 1) = points.col(k - p);
    for (int l = 1; l <= p; ++l) {
      const double from = old[i - p + l];
      const double ratio = (*u - from) / (knots[k + l] - from);
      const std::ptrdiff_t column = k - p + l - 1;
      blend(ratio,
            points.col(column + 1).data(),
            points.col(column).data(),
            points.rows());
    }
    knots[k] = *u;
  }
  std::copy(old.begin(), old.begin() + i + 1, knots.begin());
  points.leftCols(i - p) = spline.points.leftCols(i - p);
  return {KnotVector(p, std::move(knots)), std::move(points), spline.point_rows};
}

std::pair<HomogeneousSpline, HomogeneousSpline>
splitAt(const HomogeneousSpline& spline, double u)
{
  const HomogeneousSpline cut = withJumpsAt(spline, {u});
  return {slice(cut, 0, behindLastCopy(cut.knots, u)),
          slice(cut, firstCopy(cut.knots, u), cut.knots.size())};
}

HomogeneousSpline
restricted(const HomogeneousSpline& spline, double first, double last)
{
  const HomogeneousSpline cut = withJumpsAt(spline, {first, last});
  return slice(cut, firstCopy(cut.knots, first), behindLastCopy(cut.knots, last));
}

std::vector<HomogeneousSpline>
bezierPieces(const HomogeneousSpline& spline)
{
  const std::vector<double> breaks = spline.knots.breaks();
  const HomogeneousSpline cut = withJumpsAt(spline, breaks);
  std::vector<HomogeneousSpline> pieces;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    pieces.push_back(slice(cut,
                           firstCopy(cut.knots, breaks[i]),
                           behindLastCopy(cut.knots, breaks[i + 1])));
  return pieces;
}

HomogeneousSpline
concatenated(const HomogeneousSpline& left,
             const HomogeneousSpline& right,
             bool shares_point)
{
  const int shared = shares_point ? 1 : 0;
  const int degree = left.knots.degree();
  std::vector<double> knots(left.knots.values());
  knots.resize(knots.size() - static_cast<std::size_t>(shared));
  knots.insert(knots.end(),
               right.knots.values().begin() + degree + 1,
               right.knots.values().end());
  Eigen::MatrixXd points(left.points.rows(),
                         left.points.cols() + right.points.cols() - shared);
  points << left.points, right.points.rightCols(right.points.cols() - shared);
  return {KnotVector(degree, std::move(knots)), std::move(points), left.point_rows};
}

} // namespace detail
} // namespace nurbs
} // namespace pcl
