// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/knot_vector.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

void
requireValidKnots(int degree, const std::vector<double>& knots)
{
  if (degree < 1 || degree > kMaxDegree)
    throw std::invalid_argument("KnotVector: degree " + std::to_string(degree) +
                                " is not in 1.." + std::to_string(kMaxDegree));
  const auto order = static_cast<std::size_t>(degree) + 1;
  if (knots.size() < 2 * order)
    throw std::invalid_argument("KnotVector: degree " + std::to_string(degree) +
                                " needs at least " + std::to_string(2 * order) +
                                " knots, got " + std::to_string(knots.size()));
  for (double knot : knots)
    if (!std::isfinite(knot))
      throw std::invalid_argument("KnotVector: a knot is not finite");
  if (!std::is_sorted(knots.begin(), knots.end()))
    throw std::invalid_argument("KnotVector: knots decrease");
  for (std::size_t i = 0; i + order < knots.size(); ++i)
    if (knots[i] == knots[i + order])
      throw std::invalid_argument(
          "KnotVector: a knot has multiplicity above degree + 1");
  if (!(knots[order - 1] < knots[knots.size() - order]))
    throw std::invalid_argument("KnotVector: the domain is empty");
}

void
requireInterval(double first, double last, int spans)
{
  if (!(first < last))
    throw std::invalid_argument("KnotVector: the domain is empty");
  if (spans < 1)
    throw std::invalid_argument("KnotVector: needs at least one span");
}

} // namespace

KnotVector::KnotVector() : degree_(1), knots_{0.0, 0.0, 1.0, 1.0}
{
}

KnotVector::KnotVector(int degree, std::vector<double> knots)
    : degree_(degree), knots_(std::move(knots))
{
  requireValidKnots(degree_, knots_);
}

KnotVector
KnotVector::bezier(int degree, double first, double last)
{
  return clampedUniform(degree, 1, first, last);
}

KnotVector
KnotVector::clampedUniform(int degree, int spans, double first, double last)
{
  requireInterval(first, last, spans);
  std::vector<double> breaks;
  for (int i = 0; i <= spans; ++i)
    breaks.push_back(i == spans ? last : first + (last - first) * i / spans);
  return clamped(degree, breaks);
}

KnotVector
KnotVector::clamped(int degree, const std::vector<double>& breaks)
{
  if (breaks.size() < 2)
    throw std::invalid_argument("KnotVector: needs at least two breaks");
  std::vector<double> knots(breaks);
  knots.insert(knots.begin(), static_cast<std::size_t>(degree), breaks.front());
  knots.insert(knots.end(), static_cast<std::size_t>(degree), breaks.back());
  return {degree, std::move(knots)};
}

KnotVector
KnotVector::periodicUniform(int degree, int spans, double first, double last)
{
  requireInterval(first, last, spans);
  std::vector<double> knots;
  for (int i = -degree; i <= spans + degree; ++i)
    knots.push_back(i == spans ? last : first + (last - first) * i / spans);
  return {degree, std::move(knots)};
}

double
KnotVector::clampToDomain(double u) const
{
  return std::clamp(u, domainMin(), domainMax());
}

int
KnotVector::findSpan(double u) const
{
  const auto first = knots_.begin() + degree_;
  const auto last = knots_.end() - degree_ - 1;
  if (u >= *last) // last non-empty span
    return static_cast<int>(std::lower_bound(first, last, *last) - knots_.begin()) - 1;
  if (!(u > *first)) // also NaN, whose evaluation then gives NaN
    u = *first;
  // Last knot <= u, halving without branches: they would be mispredicted half the time.
  const double* base = knots_.data() + degree_;
  for (std::ptrdiff_t count = last - first; count > 1;) {
    const std::ptrdiff_t half = count / 2;
    base += base[half] <= u ? half : 0;
    count -= half;
  }
  return static_cast<int>(base - knots_.data());
}

void
KnotVector::evaluateBasis(int span, double u, BasisValues& values) const
{
  const double* knot = knots_.data() + span;
  std::array<double, kMaxDegree + 1> left;
  std::array<double, kMaxDegree + 1> right;
  values[0] = 1.0;
  for (int j = 1; j <= degree_; ++j) {
    left[j] = u - knot[1 - j];
    right[j] = knot[j] - u;
    double saved = 0.0;
    for (int r = 0; r < j; ++r) {
      const double ratio = values[r] / (right[r + 1] + left[j - r]);
      values[r] = saved + right[r + 1] * ratio;
      saved = left[j - r] * ratio;
    }
    values[j] = saved;
  }
}

void
KnotVector::evaluateBasisDerivatives(int span,
                                     double u,
                                     int order,
                                     BasisDerivatives& derivatives) const
{
  if (order < 0 || order > kMaxDegree)
    throw std::invalid_argument("KnotVector: derivative order out of range");
  // The derivative of a degree-d basis function is a difference of two degree d - 1
  // ones (equation 2.7), so derivative k of degree p starts from the values of degree p
  // - k.
  const int p = degree_;
  const double* knot = knots_.data() + span;
  BasisDerivatives by_degree{}; // by_degree[d][r]: values of degree d
  by_degree[0][0] = 1.0;
  for (int d = 1; d <= p; ++d) {
    double saved = 0.0;
    for (int r = 0; r < d; ++r) {
      const double ratio = by_degree[d - 1][r] / (knot[r + 1] - knot[1 - d + r]);
      by_degree[d][r] = saved + (knot[r + 1] - u) * ratio;
      saved = (u - knot[1 - d + r]) * ratio;
    }
    by_degree[d][d] = saved;
  }
  derivatives[0] = by_degree[p];
  for (int k = 1; k <= order; ++k) {
    derivatives[k].fill(0.0);
    if (k > p)
      continue;
    BasisValues row = by_degree[p - k];
    for (int d = p - k + 1; d <= p; ++d) { // raise the degree k times
      double saved = 0.0;
      for (int r = 0; r < d; ++r) {
        const double slope = d * row[r] / (knot[r + 1] - knot[1 - d + r]);
        row[r] = saved - slope;
        saved = slope;
      }
      row[d] = saved;
    }
    derivatives[k] = row;
  }
}

int
KnotVector::multiplicity(double u, double tolerance) const
{
  return static_cast<int>(std::count_if(knots_.begin(), knots_.end(), [=](double knot) {
    return std::abs(knot - u) <= tolerance;
  }));
}

std::vector<double>
KnotVector::breaks() const
{
  std::vector<double> result(knots_.begin() + degree_, knots_.end() - degree_);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

double
KnotVector::greville(int i) const
{
  double sum = 0.0;
  for (int k = 1; k <= degree_; ++k)
    sum += (*this)[i + k];
  return sum / degree_;
}

bool
KnotVector::isClamped() const
{
  return knots_[0] == domainMin() && knots_.back() == domainMax();
}

bool
KnotVector::isPeriodic(double relative_tolerance) const
{
  const double period = domainLength();
  const double tolerance = relative_tolerance * period;
  for (int i = 0; i + numControlPoints() - degree_ < size(); ++i)
    if (std::abs((*this)[i + numControlPoints() - degree_] - (*this)[i] - period) >
        tolerance)
      return false;
  return true;
}

KnotVector
KnotVector::reversed() const
{
  const double sum = domainMin() + domainMax();
  std::vector<double> knots(knots_.rbegin(), knots_.rend());
  for (double& knot : knots)
    knot = knot == domainMin()   ? domainMax()
           : knot == domainMax() ? domainMin()
                                 : sum - knot;
  return {degree_, std::move(knots)};
}

KnotVector
KnotVector::rescaled(double first, double last) const
{
  requireInterval(first, last, 1);
  const double scale = (last - first) / domainLength();
  std::vector<double> knots(knots_);
  for (double& knot : knots)
    knot = knot == domainMin()   ? first
           : knot == domainMax() ? last
                                 : first + (knot - domainMin()) * scale;
  return {degree_, std::move(knots)};
}

} // namespace nurbs
} // namespace pcl
