// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "principal_axes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

Eigen::Vector3d
leastExtent(const PointList& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const Eigen::Vector3f& point : points)
    if (point.allFinite()) {
      sum += point.cast<double>();
      ++count;
    }
  const Eigen::Vector3d mean = sum / std::max(count, 1.0);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3f& point : points)
    if (point.allFinite()) {
      const Eigen::Vector3d offset = point.cast<double>() - mean;
      covariance += offset * offset.transpose();
    }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance)
      .eigenvectors()
      .col(0);
}

} // namespace

Eigen::Matrix3d
principalAxes(const PointList& points)
{
  Eigen::Vector3d normal = leastExtent(points);
  Eigen::Index axis = 2;
  const double along = normal.cwiseAbs().maxCoeff(&axis);
  if (!(along < std::cos(20.0 * M_PI / 180.0)))
    normal = Eigen::Vector3d::Unit(axis);
  const Eigen::Vector3d forward = normal(axis) > 0.0 ? -normal : normal;
  // Right is as near to x as it can be; for a view along x, to y.
  const Eigen::Vector3d hint =
      axis == 0 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d down = forward.cross(hint).normalized();
  Eigen::Matrix3d axes;
  axes.row(0) = down.cross(forward);
  axes.row(1) = down;
  axes.row(2) = forward;
  return axes;
}

} // namespace nurbs
} // namespace pcl
