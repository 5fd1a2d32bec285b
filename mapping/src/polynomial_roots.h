// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <array>

namespace pcl {
namespace nurbs {

/** c[0] + c[1] t + ... + c[degree] t^degree. */
struct Polynomial {
  static constexpr int kMaxDegree = 4;

  std::array<double, kMaxDegree + 1> c{};
  int degree = 0;

  double
  operator()(double t) const;

  Polynomial
  derivative() const;
};

/** Real roots in increasing order. */
struct RootList {
  std::array<double, Polynomial::kMaxDegree> values{};
  int count = 0;
};

/** Roots in [low, high]: between the roots of the derivative the polynomial is
 * monotone, so that each of its roots has a bracket of its own, and is found to
 * rounding. A double root that rounding lifts off the axis is missed. */
RootList
rootsIn(const Polynomial& polynomial, double low, double high);

} // namespace nurbs
} // namespace pcl
