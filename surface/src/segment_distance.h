// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <algorithm>

namespace pcl {
namespace nurbs {

/** \brief Distance of a point to the segment between two points. */
template <int Dim>
double
segmentDistance(const Eigen::Matrix<double, Dim, 1>& point,
                const Eigen::Matrix<double, Dim, 1>& from,
                const Eigen::Matrix<double, Dim, 1>& to)
{
  const Eigen::Matrix<double, Dim, 1> along = to - from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? (point - from).dot(along) / length2 : 0.0;
  return (point - from - std::clamp(t, 0.0, 1.0) * along).norm();
}

} // namespace nurbs
} // namespace pcl
