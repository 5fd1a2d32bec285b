// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>
#include <string>

namespace pcl {
namespace nurbs {

/** \brief Refuse a size that is not a positive finite number. */
inline void
requirePositive(double value, const char* what)
{
  if (!(value > 0.0) || !std::isfinite(value))
    throw std::invalid_argument(std::string(what) + " must be positive and finite");
}

/** \brief Refuse a frame that is not a rotation and a translation: the sizes of a shape
 * would silently scale with it. */
template <int Dim>
void
requireRigid(const Eigen::Transform<double, Dim, Eigen::Isometry>& frame)
{
  constexpr double kTolerance = 1e-9;
  const Eigen::Matrix<double, Dim, Dim> rotation = frame.linear();
  const bool rigid = frame.matrix().allFinite() && rotation.isUnitary(kTolerance) &&
                     rotation.determinant() > 0.0;
  if (!rigid)
    throw std::invalid_argument("frame is not a rotation and a translation");
}

} // namespace nurbs
} // namespace pcl
