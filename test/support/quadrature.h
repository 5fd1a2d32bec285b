// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <cmath>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

/** Node and weight of a quadrature rule on [-1, 1]. */
using QuadraturePoint = std::pair<double, double>;

/** Gauss-Legendre rule, exact for polynomials of degree 2 n - 1: the nodes are found by
 * Newton's method on the Legendre polynomial. */
inline std::vector<QuadraturePoint>
gaussLegendre(int n)
{
  std::vector<QuadraturePoint> rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(3.14159265358979323846 * (i + 0.75) / (n + 0.5));
    double slope = 0.0;
    for (int iteration = 0; iteration < 10; ++iteration) {
      double previous = 1.0;
      double value = x;
      for (int k = 2; k <= n; ++k)
        previous = std::exchange(
            value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k);
      slope = n * (x * value - previous) / (x * x - 1.0);
      x -= value / slope;
    }
    rule.emplace_back(x, 2.0 / ((1.0 - x * x) * slope * slope));
  }
  return rule;
}

/** Area by a product rule of \a order points squared on every span. */
inline double
quadratureArea(const NurbsSurface& surface, int order)
{
  const std::vector<QuadraturePoint> rule = gaussLegendre(order);
  const std::vector<double> u = surface.knotsU().breaks();
  const std::vector<double> v = surface.knotsV().breaks();
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < u.size(); ++i)
    for (std::size_t j = 0; j + 1 < v.size(); ++j)
      for (const auto& [x, weight_x] : rule)
        for (const auto& [y, weight_y] : rule) {
          const double half_u = 0.5 * (u[i + 1] - u[i]);
          const double half_v = 0.5 * (v[j + 1] - v[j]);
          const SurfaceJet1 jet = surface.evaluateJet1(u[i] + half_u * (1.0 + x),
                                                       v[j] + half_v * (1.0 + y));
          area += weight_x * weight_y * half_u * half_v * jet.du.cross(jet.dv).norm();
        }
  return area;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
