// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "homogeneous_spline.h"

#include <algorithm>
#include <iterator>

namespace pcl {
namespace nurbs {
namespace detail {
namespace {

/** Drop control points without influence on the domain: those in front of copies of
 * its first knot that stand behind knot p, and likewise at the end. */
HomogeneousSpline
withoutUnusedEnds(const HomogeneousSpline& spline)
{
  const KnotVector& knots = spline.knots;
  const int p = knots.degree();
  const int front = knots.findSpan(knots.domainMin()) - p;
  const int used = knots.findSpan(knots.domainMax()) + 1 - front;
  const auto begin = knots.values().begin() + front;
  return {KnotVector(p, std::vector<double>(begin, begin + used + p + 1)),
          spline.points.middleCols(front, used),
          spline.point_rows};
}

/** The first inner knot with degree + 1 copies, or the end of the domain. */
double
firstJump(const KnotVector& knots)
{
  const std::vector<double> breaks = knots.breaks();
  const auto jump = std::find_if(breaks.begin() + 1, breaks.end() - 1, [&](double u) {
    return knots.multiplicity(u) > knots.degree();
  });
  return *jump;
}

/** Every distinct knot once more. */
std::vector<double>
withOneMoreCopy(const std::vector<double>& knots)
{
  std::vector<double> result;
  for (std::size_t i = 0; i < knots.size(); ++i)
    result.insert(result.end(),
                  i + 1 == knots.size() || knots[i + 1] != knots[i] ? 2 : 1,
                  knots[i]);
  return result;
}

/** The outermost knots replaced by degree + 1 distinct ones on each side, so that
 * knots can be inserted outside of the domain too. The points added there are zero;
 * nothing that is kept depends on them. */
HomogeneousSpline
padded(const HomogeneousSpline& spline)
{
  const int p = spline.knots.degree();
  const std::vector<double>& u = spline.knots.values();
  const double step = spline.knots.domainLength();
  std::vector<double> knots(u.begin() + 1, u.end() - 1);
  const double low = knots.front();
  const double high = knots.back();
  for (int k = 1; k <= p + 1; ++k) {
    knots.insert(knots.begin(), low - k * step);
    knots.push_back(high + k * step);
  }
  Eigen::MatrixXd points =
      Eigen::MatrixXd::Zero(spline.points.rows(), spline.points.cols() + 2 * p);
  points.middleCols(p, spline.points.cols()) = spline.points;
  return {KnotVector(p, std::move(knots)), std::move(points), spline.point_rows};
}

/** Add the control points of one refinement to the sum over all windows of p + 1
 * raised knots: the refinement has all raised knots but those whose index is
 * \a omitted modulo p + 1, hence one less in each window. */
void
addRefinement(const HomogeneousSpline& pad,
              const std::vector<double>& inner,
              const std::vector<double>& raised,
              int omitted,
              Eigen::MatrixXd& sum)
{
  const int p = pad.knots.degree();
  std::vector<double> kept;
  for (std::size_t i = 0; i < raised.size(); ++i)
    if (static_cast<int>(i) % (p + 1) != omitted)
      kept.push_back(raised[i]);
  std::vector<double> added;
  std::set_difference(
      kept.begin(), kept.end(), inner.begin(), inner.end(), std::back_inserter(added));
  const Eigen::MatrixXd points = refined(pad, added).points;
  for (Eigen::Index window = 0; window < sum.cols(); ++window) {
    const Eigen::Index first = window % (p + 1) == omitted ? window + 1 : window;
    const Eigen::Index omitted_before = (first + p - omitted) / (p + 1);
    sum.col(window) += points.col(p + first - omitted_before);
  }
}

/** Cut the knots and points of the raised spline down to the domain. */
HomogeneousSpline
cutToDomain(const HomogeneousSpline& spline,
            const std::vector<double>& raised,
            const Eigen::MatrixXd& points)
{
  const std::vector<double>& u = spline.knots.values();
  const int degree = spline.knots.degree() + 1;
  const auto begin = raised.begin();
  const auto low = std::upper_bound(begin, raised.end(), spline.knots.domainMin()) -
                   begin - 1 - degree;
  const auto high =
      std::lower_bound(begin, raised.end(), spline.knots.domainMax()) - begin + degree;
  // The outermost knots carry no influence and were left out: bring them back.
  std::vector<double> knots;
  if (low < 0)
    knots.push_back(u.front());
  const auto size = static_cast<std::ptrdiff_t>(raised.size());
  knots.insert(knots.end(),
               begin + std::max<std::ptrdiff_t>(low, 0),
               begin + std::min(high + 1, size));
  if (high == size)
    knots.push_back(u.back());
  return {KnotVector(degree, std::move(knots)),
          points.middleCols(low + 1, high - low - degree),
          spline.point_rows};
}

} // namespace

// The polar form of degree p + 1 is the mean, over its arguments, of the form of degree
// p without that argument (section 5.5 for one span). A control point is the polar form
// of consecutive knots, so the raised control points are means of p + 1 refinements of
// the spline: convex combinations throughout, with no knot removal as in A5.9.
HomogeneousSpline
elevated(const HomogeneousSpline& input)
{
  const HomogeneousSpline spline = withoutUnusedEnds(input);
  const double jump = firstJump(spline.knots);
  if (jump < spline.knots.domainMax()) {
    const auto [left, right] = splitAt(spline, jump);
    return concatenated(elevated(left), elevated(right), false);
  }
  const int p = spline.knots.degree();
  const std::vector<double>& u = spline.knots.values();
  const std::vector<double> inner(u.begin() + 1, u.end() - 1);
  const std::vector<double> raised = withOneMoreCopy(inner);
  const HomogeneousSpline pad = padded(spline);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(
      spline.points.rows(), static_cast<Eigen::Index>(raised.size()) - p);
  for (int omitted = 0; omitted <= p; ++omitted)
    addRefinement(pad, inner, raised, omitted, sum);
  return cutToDomain(spline, raised, sum / (p + 1.0));
}

} // namespace detail
} // namespace nurbs
} // namespace pcl
