// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/registration/rigid_motion.h>

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kSmallAngle = 1e-4; // where the series is exact to double precision

/** Left Jacobian of SO(3), Barfoot eq. 7.77b. */
Eigen::Matrix3d
leftJacobian(const Eigen::Vector3d& rotation)
{
  const double angle = rotation.norm();
  const bool small = angle < kSmallAngle;
  const double square = angle * angle;
  const double a = small ? 0.5 - square / 24.0 : (1.0 - std::cos(angle)) / square;
  const double b =
      small ? 1.0 / 6.0 - square / 120.0 : (angle - std::sin(angle)) / (square * angle);
  const Eigen::Matrix3d k = crossMatrix(rotation);
  return Eigen::Matrix3d::Identity() + a * k + b * k * k;
}

} // namespace

Eigen::Matrix3d
crossMatrix(const Eigen::Vector3d& vector)
{
  Eigen::Matrix3d matrix;
  matrix << 0.0, -vector.z(), vector.y(), vector.z(), 0.0, -vector.x(), -vector.y(),
      vector.x(), 0.0;
  return matrix;
}

TangentMatrix
adjoint(const Eigen::Isometry3d& motion)
{
  TangentMatrix result = TangentMatrix::Zero();
  result.topLeftCorner<3, 3>() = motion.linear();
  result.bottomRightCorner<3, 3>() = motion.linear();
  result.topRightCorner<3, 3>() = crossMatrix(motion.translation()) * motion.linear();
  return result;
}

Eigen::Isometry3d
exponential(const Tangent& tangent)
{
  const Eigen::Vector3d rotation = tangent.tail<3>();
  const double angle = rotation.norm();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (angle > 0.0)
    motion.linear() = Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
  motion.translation() = leftJacobian(rotation) * tangent.head<3>();
  return motion;
}

Tangent
logarithm(const Eigen::Isometry3d& motion)
{
  Eigen::Quaterniond q(motion.linear());
  if (q.w() < 0.0)
    q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  const double factor = sine < 1e-12 ? 2.0 : 2.0 * std::atan2(sine, q.w()) / sine;
  Tangent tangent;
  tangent.tail<3>() = factor * q.vec();
  tangent.head<3>() = leftJacobian(tangent.tail<3>()).inverse() * motion.translation();
  return tangent;
}

Eigen::Isometry3d
orthonormal(const Eigen::Isometry3d& motion)
{
  Eigen::Isometry3d result = motion;
  result.linear() = Eigen::Quaterniond(motion.linear()).normalized().toRotationMatrix();
  return result;
}

} // namespace nurbs
} // namespace pcl
