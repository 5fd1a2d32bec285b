// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/fit_options.h>

#include <cmath>

namespace pcl {
namespace nurbs {

/** \brief Value rho(s) and slope rho'(s) of a loss at s, a squared residual in units of
 * the noise. All losses are concave in s with rho(0) = 0 and rho'(0) = 1, so rho'(s) s
 * <= rho(s).
 */
struct LossValue {
  double rho;
  double slope;
};

inline LossValue
evaluateLoss(RobustLoss loss, double scale, double s)
{
  const double c = scale * scale;
  switch (loss) {
  case RobustLoss::Huber:
    if (s <= c)
      return {s, 1.0};
    return {2.0 * scale * std::sqrt(s) - c, scale / std::sqrt(s)};
  case RobustLoss::Cauchy:
    return {c * std::log1p(s / c), 1.0 / (1.0 + s / c)};
  case RobustLoss::Tukey: {
    if (s >= c)
      return {c / 3.0, 0.0};
    const double rest = 1.0 - s / c;
    return {c / 3.0 * (1.0 - rest * rest * rest), rest * rest};
  }
  case RobustLoss::Squared:
    break;
  }
  return {s, 1.0};
}

} // namespace nurbs
} // namespace pcl
