// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "polynomial_roots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl {
namespace nurbs {
namespace {

/** Newton's method, by bisection where that leaves the bracket. */
double
rootInBracket(const Polynomial& f, const Polynomial& slope, double low, double high)
{
  constexpr int kMostSteps = 80;
  const bool rising = f(low) < 0.0;
  double t = 0.5 * (low + high);
  for (int step = 0; step < kMostSteps; ++step) {
    const double value = f(t);
    if (value == 0.0)
      return t;
    ((value < 0.0) == rising ? low : high) = t;
    double next = t - value / slope(t);
    if (!(next > low && next < high))
      next = 0.5 * (low + high);
    if (std::abs(next - t) <= 1e-15 * std::abs(next) || next == low || next == high)
      return next;
    t = next;
  }
  return t;
}

void
append(RootList& roots, double value)
{
  if (roots.count < Polynomial::kMaxDegree &&
      (roots.count == 0 ||
       roots.values[static_cast<std::size_t>(roots.count) - 1] < value))
    roots.values[static_cast<std::size_t>(roots.count++)] = value;
}

/** Both roots without a difference of nearly equal numbers. */
RootList
rootsOfQuadratic(const Polynomial& f, double low, double high)
{
  RootList roots;
  const double half = 0.5 * f.c[1];
  const double square = half * half - f.c[0] * f.c[2];
  if (!(square >= 0.0))
    return roots;
  const double q = -(half + std::copysign(std::sqrt(square), half));
  const double one = q / f.c[2];
  const double other = q != 0.0 ? f.c[0] / q : one;
  for (const double root : {std::min(one, other), std::max(one, other)})
    if (root >= low && root <= high)
      append(roots, root);
  return roots;
}

} // namespace

double
Polynomial::operator()(double t) const
{
  double value = c[static_cast<std::size_t>(degree)];
  for (int k = degree - 1; k >= 0; --k)
    value = value * t + c[static_cast<std::size_t>(k)];
  return value;
}

Polynomial
Polynomial::derivative() const
{
  Polynomial result;
  result.degree = degree > 0 ? degree - 1 : 0;
  for (int k = 1; k <= degree; ++k)
    result.c[static_cast<std::size_t>(k) - 1] = k * c[static_cast<std::size_t>(k)];
  return result;
}

RootList
rootsIn(const Polynomial& polynomial, double low, double high)
{
  RootList roots;
  if (polynomial.degree == 0)
    return roots;
  if (polynomial.degree == 1) {
    const double root = -polynomial.c[0] / polynomial.c[1];
    if (root >= low && root <= high)
      append(roots, root);
    return roots;
  }
  if (polynomial.degree == 2)
    return rootsOfQuadratic(polynomial, low, high);
  const Polynomial slope = polynomial.derivative();
  const RootList turns = rootsIn(slope, low, high);
  double from = low;
  double value_from = polynomial(from);
  if (value_from == 0.0)
    append(roots, from);
  for (int k = 0; k <= turns.count; ++k) {
    const double to =
        k < turns.count ? turns.values[static_cast<std::size_t>(k)] : high;
    const double value_to = polynomial(to);
    if (value_to == 0.0)
      append(roots, to);
    else if (value_from != 0.0 && (value_from < 0.0) != (value_to < 0.0))
      append(roots, rootInBracket(polynomial, slope, from, to));
    from = to;
    value_from = value_to;
  }
  return roots;
}

} // namespace nurbs
} // namespace pcl
