// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "homogeneous_spline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl {
namespace nurbs {
namespace detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** Control columns [first, first + old_count) and what stands there afterwards. */
struct Removal {
  Eigen::Index first;
  Eigen::Index old_count;
  Eigen::MatrixXd replacement;
  double error;
};

double
signOf(double value)
{
  return value < 0.0 ? -1.0 : 1.0;
}

/** Removes knots one at a time and keeps, for every knot span, a bound of how far the
 * curve over it has moved so far. */
class KnotRemover {
public:
  explicit KnotRemover(HomogeneousSpline spline)
      : knots_(spline.knots.values()),
        points_(std::move(spline.points)),
        degree_(spline.knots.degree()),
        point_rows_(spline.point_rows),
        span_error_(knots_.size(), 0.0),
        cost_(knots_.size(), kInfinity)
  {
  }

  /** Find what removing each knot in [from, to) costs. */
  void
  updateCosts(Eigen::Index from, Eigen::Index to)
  {
    const Eigen::Index end = std::min<Eigen::Index>(to, points_.cols());
    for (Eigen::Index r = std::max<Eigen::Index>(from, degree_ + 1); r < end; ++r)
      cost_[r] = isInnerLastCopy(r) ? removal(r).error : kInfinity;
  }

  void
  updateAllCosts()
  {
    updateCosts(0, points_.cols());
  }

  /** Bound of the distance to the original curve once knot \a r is removed. */
  double
  errorAfter(Eigen::Index r) const
  {
    if (cost_[r] == kInfinity)
      return kInfinity;
    const Eigen::Index copies = copiesOf(r);
    const auto begin =
        span_error_.begin() + r - std::max<Eigen::Index>(degree_, copies);
    return cost_[r] + *std::max_element(begin, span_error_.begin() + lastSpan(r) + 1);
  }

  /** Inner knot whose removal moves the curve least. */
  Eigen::Index
  cheapest() const
  {
    Eigen::Index best = 0;
    double least = kInfinity;
    for (Eigen::Index r = 1; r < static_cast<Eigen::Index>(knots_.size()); ++r) {
      if (!(cost_[r] < least)) // errors so far can only add to it
        continue;
      const double error = errorAfter(r);
      if (error < least) {
        least = error;
        best = r;
      }
    }
    return best;
  }

  /** Last copy of the knot \a u. */
  Eigen::Index
  indexOf(double u) const
  {
    return std::upper_bound(knots_.begin(), knots_.end(), u) - knots_.begin() - 1;
  }

  void
  remove(Eigen::Index r)
  {
    const Removal change = removal(r);
    const Eigen::Index last = lastSpan(r);
    for (Eigen::Index span = change.first; span <= last; ++span)
      span_error_[span] += change.error;
    span_error_[r - 1] = std::max(span_error_[r - 1], span_error_[r]);
    span_error_.erase(span_error_.begin() + r);
    knots_.erase(knots_.begin() + r);
    cost_.erase(cost_.begin() + r);
    const Eigen::Index tail = points_.cols() - change.first - change.old_count;
    Eigen::MatrixXd points(points_.rows(), points_.cols() - 1);
    points << points_.leftCols(change.first), change.replacement,
        points_.rightCols(tail);
    points_ = std::move(points);
    updateCosts(r - 2 * degree_ - 2, r + 2 * degree_ + 2);
  }

  double
  maxError() const
  {
    return *std::max_element(span_error_.begin(), span_error_.end());
  }

  HomogeneousSpline
  result() const
  {
    return {KnotVector(degree_, knots_), points_, point_rows_};
  }

private:
  bool
  isInnerLastCopy(Eigen::Index r) const
  {
    return knots_[r] != knots_[r + 1] && knots_[r] > knots_[degree_] &&
           knots_[r] < knots_[points_.cols()];
  }

  Eigen::Index
  copiesOf(Eigen::Index r) const
  {
    return std::upper_bound(knots_.begin(), knots_.end(), knots_[r]) -
           std::lower_bound(knots_.begin(), knots_.end(), knots_[r]);
  }

  /** Last span over which the curve moves when knot \a r is removed. */
  Eigen::Index
  lastSpan(Eigen::Index r) const
  {
    return std::max(r - copiesOf(r) + degree_, r);
  }

  Removal
  removal(Eigen::Index r) const
  {
    return copiesOf(r) > degree_ ? jumpRemoval(r) : smoothRemoval(r);
  }

  /** At a jump, two control points become one: take their mean. */
  Removal
  jumpRemoval(Eigen::Index r) const
  {
    const auto left = points_.col(r - degree_ - 1);
    const auto right = points_.col(r - degree_);
    Removal change{r - degree_ - 1, 2, 0.5 * (left + right), 0.0};
    bound(r, 0.5 * (right - left), change);
    return change;
  }

  Removal
  smoothRemoval(Eigen::Index r) const;

  void
  bound(Eigen::Index r, const Eigen::VectorXd& defect, Removal& change) const
  {
    const Eigen::Index begin = std::max<Eigen::Index>(0, r - 2 * degree_ - 1);
    const Eigen::Index end = std::min(points_.cols(), r + degree_ + 1);
    const auto around = points_.middleCols(begin, end - begin);
    double weight = leastWeight(around, point_rows_);
    if (change.replacement.cols() > 0)
      weight = std::min(weight, leastWeight(change.replacement, point_rows_));
    change.error = deviationBound(defect, around, weight, point_rows_);
  }

  std::vector<double> knots_;
  Eigen::MatrixXd points_;
  int degree_;
  int point_rows_;
  std::vector<double> span_error_; // one per knot: the span that starts there
  std::vector<double> cost_;       // one per knot: infinite if it cannot be removed
};

// Inserting the knot would make P_i = a_i Q_i + (1 - a_i) Q_{i-1} (equation 5.28) for
// one equation more than there are unknown Q. Removal therefore leaves a defect. A5.8
// puts all of it into one equation; here the defects are of equal size in all of them,
// with the signs of the null vector y of the transposed system, which is the solution
// of least maximum. Their alternation makes the curve move far less still.
Removal
KnotRemover::smoothRemoval(Eigen::Index r) const
{
  const Eigen::Index first = r - degree_;
  const Eigen::Index count = degree_ - copiesOf(r) + 1;
  Eigen::ArrayXd ratio(count);
  for (Eigen::Index l = 0; l < count; ++l)
    ratio(l) = (knots_[r] - knots_[first + l]) /
               (knots_[first + l + degree_ + 1] - knots_[first + l]);
  Eigen::VectorXd y = Eigen::VectorXd::Ones(count);
  for (Eigen::Index l = 1; l < count; ++l)
    y(l) = -y(l - 1) * ratio(l - 1) / (1.0 - ratio(l));

  const Eigen::VectorXd before = points_.col(first - 1);
  const Eigen::VectorXd after = points_.col(first + count);
  Eigen::MatrixXd target = points_.middleCols(first, count);
  const Eigen::VectorXd defect = (target * y - y(0) * (1.0 - ratio(0)) * before -
                                  y(count - 1) * ratio(count - 1) * after) /
                                 y.lpNorm<1>();
  for (Eigen::Index l = 0; l < count; ++l)
    target.col(l) -= signOf(y(l)) * defect;

  // Solve from both sides up to the equation with the greatest y: no growth of errors.
  Eigen::Index pivot = 0;
  y.cwiseAbs().maxCoeff(&pivot);
  Removal change{first, count, Eigen::MatrixXd(points_.rows(), count - 1), 0.0};
  Eigen::MatrixXd& q = change.replacement;
  Eigen::VectorXd known = before;
  for (Eigen::Index l = 0; l < pivot; ++l)
    q.col(l) = known = (target.col(l) - (1.0 - ratio(l)) * known) / ratio(l);
  known = after;
  for (Eigen::Index l = count - 1; l > pivot; --l)
    q.col(l - 1) = known = (target.col(l) - ratio(l) * known) / (1.0 - ratio(l));
  bound(r, defect, change);
  return change;
}

} // namespace

SimplifiedSpline
withoutKnot(const HomogeneousSpline& spline, double u, int times, double tolerance)
{
  KnotRemover remover(spline);
  int removed = 0;
  for (; removed < times; ++removed) {
    const Eigen::Index r = remover.indexOf(u);
    remover.updateCosts(r, r + 1);
    if (!(remover.errorAfter(r) <= tolerance))
      break;
    remover.remove(r);
  }
  return {remover.result(), removed, remover.maxError()};
}

SimplifiedSpline
withoutRedundantKnots(const HomogeneousSpline& spline, double tolerance)
{
  KnotRemover remover(spline);
  remover.updateAllCosts();
  int removed = 0;
  for (Eigen::Index r = remover.cheapest(); remover.errorAfter(r) <= tolerance;
       r = remover.cheapest(), ++removed)
    remover.remove(r);
  return {remover.result(), removed, remover.maxError()};
}

} // namespace detail
} // namespace nurbs
} // namespace pcl
