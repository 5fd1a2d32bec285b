// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Binomial coefficient as a double; exact for the small arguments used here. */
inline double
binomial(int n, int k)
{
  double result = 1.0;
  for (int i = 1; i <= k; ++i)
    result = result * (n - k + i) / i;
  return result;
}

/** \brief Derivatives of a rational curve from those of its homogeneous form
 * (algorithm A4.2). */
template <int Dim>
std::vector<Eigen::Matrix<double, Dim, 1>>
rationalCurveDerivatives(
    const std::vector<Eigen::Matrix<double, Dim + 1, 1>>& homogeneous)
{
  std::vector<Eigen::Matrix<double, Dim, 1>> result(homogeneous.size());
  for (int k = 0; k < static_cast<int>(homogeneous.size()); ++k) {
    Eigen::Matrix<double, Dim, 1> value = homogeneous[k].template head<Dim>();
    for (int i = 1; i <= k; ++i)
      value -= binomial(k, i) * homogeneous[i](Dim) * result[k - i];
    result[k] = value / homogeneous[0](Dim);
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
