// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "pose_error.h"

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** E = Z^-1 A^-1 B, its rotation with w >= 0. */
struct RelativeError {
  Eigen::Matrix3d first_axes;  // R_Z^T
  Eigen::Vector3d second_seen; // B's position in A's frame
  SolverPose error;
};

RelativeError
relativeError(const SolverPose& measured, const SolverPose& a, const SolverPose& b)
{
  RelativeError result;
  const Eigen::Quaterniond back = measured.rotation.conjugate();
  const Eigen::Quaterniond a_back = a.rotation.conjugate();
  result.first_axes = back.toRotationMatrix();
  result.second_seen = a_back * (b.translation - a.translation);
  result.error.translation =
      result.first_axes * (result.second_seen - measured.translation);
  result.error.rotation = back * (a_back * b.rotation);
  if (result.error.rotation.w() < 0.0)
    result.error.rotation.coeffs() = -result.error.rotation.coeffs();
  return result;
}

Tangent
tangentOf(const SolverPose& error, ErrorKind kind)
{
  Tangent result;
  result << error.translation, 2.0 * error.rotation.vec();
  if (kind == ErrorKind::PlaneAngle)
    result(5) = 2.0 * std::atan2(error.rotation.z(), error.rotation.w());
  return result;
}

void
linearizePose(const ErrorModel& model,
              const SolverPose& first,
              const SolverPose& second,
              ErrorValues& values)
{
  const RelativeError relative = relativeError(model.measured, first, second);
  const Eigen::Quaterniond& q = relative.error.rotation;
  values.error = tangentOf(relative.error, model.kind);
  const Eigen::Matrix3d cross = crossMatrix(q.vec());
  const Eigen::Matrix3d scaled = q.w() * Eigen::Matrix3d::Identity();
  values.first.topLeftCorner<3, 3>() = -relative.first_axes;
  values.first.topRightCorner<3, 3>().noalias() =
      relative.first_axes * crossMatrix(relative.second_seen);
  values.first.bottomLeftCorner<3, 3>().setZero();
  values.first.bottomRightCorner<3, 3>().noalias() =
      (cross - scaled) * relative.first_axes;
  values.second.topLeftCorner<3, 3>() = q.toRotationMatrix();
  values.second.topRightCorner<3, 3>().setZero();
  values.second.bottomLeftCorner<3, 3>().setZero();
  values.second.bottomRightCorner<3, 3>() = scaled + cross;
  if (model.kind == ErrorKind::PlaneAngle) { // all rotations are about z
    values.first.row(5).setUnit(5);
    values.first.row(5) *= -1.0;
    values.second.row(5).setUnit(5);
  }
}

Tangent
pointError(const ErrorModel& model, const SolverPose& pose)
{
  Tangent error = Tangent::Zero();
  if (model.kind == ErrorKind::Position)
    error.head<3>() = pose.translation + pose.rotation * model.body - model.world;
  else
    error.head<3>() = pose.rotation.conjugate() * model.world - model.body;
  return error;
}

} // namespace

SolverPose
toSolverPose(const Eigen::Isometry3d& pose)
{
  return {pose.translation(), Eigen::Quaterniond(pose.linear()).normalized()};
}

Eigen::Isometry3d
toIsometry(const SolverPose& pose)
{
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = pose.rotation.toRotationMatrix();
  result.translation() = pose.translation;
  return result;
}

SolverPose
retract(const SolverPose& pose, const Tangent& tangent)
{
  const Eigen::Vector3d half = 0.5 * tangent.tail<3>();
  const double angle = half.norm();
  const double sinc =
      angle < 1e-4 ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle;
  Eigen::Quaterniond turn;
  turn.w() = std::cos(angle);
  turn.vec() = sinc * half;
  return {pose.translation + pose.rotation * tangent.head<3>(),
          (pose.rotation * turn).normalized()};
}

Tangent
localTangent(const SolverPose& from, const SolverPose& to)
{
  Tangent result;
  const Eigen::Quaterniond back = from.rotation.conjugate();
  result.head<3>() = back * (to.translation - from.translation);
  Eigen::Quaterniond turn = back * to.rotation;
  if (turn.w() < 0.0)
    turn.coeffs() = -turn.coeffs();
  const double sine = turn.vec().norm();
  const double factor = sine < 1e-12 ? 2.0 : 2.0 * std::atan2(sine, turn.w()) / sine;
  result.tail<3>() = factor * turn.vec();
  return result;
}

Tangent
errorOf(const ErrorModel& model, const SolverPose& first, const SolverPose& second)
{
  if (model.kind == ErrorKind::Position || model.kind == ErrorKind::Direction)
    return pointError(model, second);
  return tangentOf(relativeError(model.measured, first, second).error, model.kind);
}

void
linearizeError(const ErrorModel& model,
               const SolverPose& first,
               const SolverPose& second,
               ErrorValues& values)
{
  if (model.kind == ErrorKind::Pose || model.kind == ErrorKind::PlaneAngle) {
    linearizePose(model, first, second, values);
    return;
  }
  values.error = pointError(model, second);
  values.first.setZero();
  values.second.setZero();
  const Eigen::Matrix3d rotation = second.rotation.toRotationMatrix();
  if (model.kind == ErrorKind::Position) {
    values.second.topLeftCorner<3, 3>() = rotation;
    values.second.topRightCorner<3, 3>() = -rotation * crossMatrix(model.body);
  }
  else {
    values.second.topRightCorner<3, 3>() =
        crossMatrix(rotation.transpose() * model.world);
  }
}

} // namespace nurbs
} // namespace pcl
