// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {

/** \brief What large residuals may do to an estimate.
 * \ingroup registration */
enum class RobustKernelType {
  None,        /**< r^2 / 2 */
  Huber,       /**< grows linearly beyond the width */
  GemanMcClure /**< r^2 / 2 / (1 + r^2 / width^2): bounded */
};

/** \brief A robust loss rho(r) of residuals in metres, by its weights
 * rho'(r) / r (Zhang, Parameter estimation techniques, 1997, table 1). */
struct RobustKernel {
  RobustKernelType type = RobustKernelType::GemanMcClure;
  /** Residual where the loss leaves the square, metres; 0 means three standard
   * deviations of the residuals, found in each iteration from their median. */
  double width = 0.0;

  /** \brief Weight of a residual with this square in the normal equations. */
  double
  weight(double square) const
  {
    const double limit = width * width;
    switch (type) {
    case RobustKernelType::Huber:
      return square <= limit ? 1.0 : width / std::sqrt(square);
    case RobustKernelType::GemanMcClure: {
      const double ratio = limit / (limit + square);
      return ratio * ratio;
    }
    case RobustKernelType::None:
      break;
    }
    return 1.0;
  }

  /** \brief Second derivative of the loss along the residual; may be negative. */
  double
  curvature(double square) const
  {
    const double limit = width * width;
    switch (type) {
    case RobustKernelType::Huber:
      return square <= limit ? 1.0 : 0.0;
    case RobustKernelType::GemanMcClure:
      return weight(square) * (limit - 3.0 * square) / (limit + square);
    case RobustKernelType::None:
      break;
    }
    return 1.0;
  }
};

} // namespace nurbs
} // namespace pcl
