// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/rigid_motion.h>

#include <cmath>

namespace pcl {
namespace nurbs {

/** Upper triangle by rows to a symmetric matrix. */
template <int Size>
Eigen::Matrix<double, Size, Size>
symmetric(const double* upper)
{
  Eigen::Matrix<double, Size, Size> matrix;
  for (int row = 0; row < Size; ++row)
    for (int column = row; column < Size; ++column)
      matrix(row, column) = matrix(column, row) = *upper++;
  return matrix;
}

/** Pose from x y angle. */
inline Eigen::Isometry3d
planarPose(const double* x_y_angle)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << x_y_angle[0], x_y_angle[1], 0.0;
  const double c = std::cos(x_y_angle[2]);
  const double s = std::sin(x_y_angle[2]);
  pose.linear().topLeftCorner<2, 2>() << c, -s, s, c;
  return pose;
}

/** Information about x, y, angle as one about a Tangent. */
inline TangentMatrix
planarInformation(const double* upper)
{
  const Eigen::Matrix3d block = symmetric<3>(upper);
  TangentMatrix result = TangentMatrix::Zero();
  result.topLeftCorner<2, 2>() = block.topLeftCorner<2, 2>();
  result.topRightCorner<2, 1>() = block.topRightCorner<2, 1>();
  result.bottomLeftCorner<1, 2>() = block.bottomLeftCorner<1, 2>();
  result(5, 5) = block(2, 2);
  return result;
}

/** g2o's error in space has half of our rotation. */
inline TangentMatrix
spatialInformation(const double* upper)
{
  TangentMatrix result = symmetric<6>(upper);
  result.rightCols<3>() *= 0.5;
  result.bottomRows<3>() *= 0.5;
  return result;
}

} // namespace nurbs
} // namespace pcl
