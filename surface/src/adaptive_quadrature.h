// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <boost/math/quadrature/gauss.hpp>

#include <cmath>
#include <queue>
#include <stdexcept>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A rectangle of parameters; a curve has one of zero height. */
struct QuadratureCell {
  double u_min, u_max, v_min, v_max;
};

/** \brief Gauss-Legendre sum of \a f(u) over [low, high]. */
template <int Points, typename Function>
double
gaussLegendre(double low, double high, Function f)
{
  return boost::math::quadrature::gauss<double, Points>::integrate(f, low, high);
}

/** \brief Integral over a set of cells, the cell of the largest error halved first.
 * \param[in] cells pieces on which the integrand is smooth
 * \param[in] rule rule(cell, fine) approximates the integral over a cell; the
 *            difference between the coarse and the fine rule estimates the error
 * \param[in] halve halve(cell) gives the two halves
 * \param[in] relative_tolerance share of the integral, at least 1e-13 */
template <typename Rule, typename Halve>
double
integrateAdaptively(const std::vector<QuadratureCell>& cells,
                    Rule rule,
                    Halve halve,
                    double relative_tolerance)
{
  if (!(relative_tolerance >= 1e-13))
    throw std::invalid_argument("quadrature: the tolerance must be at least 1e-13");
  struct Part {
    QuadratureCell cell;
    double value;
    double error;
    bool
    operator<(const Part& other) const
    {
      return error < other.error;
    }
  };
  std::priority_queue<Part> parts;
  double value = 0.0;
  double error = 0.0;
  const auto add = [&](const QuadratureCell& cell) {
    const double fine = rule(cell, true);
    const double difference = std::abs(fine - rule(cell, false));
    parts.push({cell, fine, difference});
    value += fine;
    error += difference;
  };
  for (const QuadratureCell& cell : cells)
    add(cell);
  // Cells at a singular point halve towards it; the limit ends that below rounding.
  constexpr int kMaxHalvings = 20000;
  for (int i = 0; i < kMaxHalvings && error > relative_tolerance * std::abs(value);
       ++i) {
    const Part worst = parts.top();
    parts.pop();
    value -= worst.value;
    error -= worst.error;
    for (const QuadratureCell& half : halve(worst.cell))
      add(half);
  }
  return value;
}

} // namespace nurbs
} // namespace pcl
