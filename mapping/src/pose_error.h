// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph_factors.h>

#include <Eigen/Geometry>

namespace pcl {
namespace nurbs {

/** A pose as the solvers hold it: from the node's frame to the world's. */
struct SolverPose {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

SolverPose
toSolverPose(const Eigen::Isometry3d& pose);

Eigen::Isometry3d
toIsometry(const SolverPose& pose);

/** T * exp(tangent) to first order, the translation moved in the pose's axes and the
 * rotation by its exponential. */
SolverPose
retract(const SolverPose& pose, const Tangent& tangent);

/** Inverse of retract(): the tangent from one pose to another. */
Tangent
localTangent(const SolverPose& from, const SolverPose& to);

enum class ErrorKind {
  Pose,       /**< translation and 2 sin(angle / 2) along the axis */
  PlaneAngle, /**< translation and the angle about z */
  Position,
  Direction
};

/** What a factor compares, in the solvers' form. A prior is a pose as seen from the
 * world, whose own pose is the identity. */
struct ErrorModel {
  ErrorKind kind = ErrorKind::Pose;
  SolverPose measured;                             /**< poses */
  Eigen::Vector3d world = Eigen::Vector3d::Zero(); /**< point or direction */
  Eigen::Vector3d body = Eigen::Vector3d::Zero();  /**< the same in the node's frame */
};

/** An error in 6 rows (positions and directions: 3, then zeros) and its derivatives. */
struct ErrorValues {
  Tangent error = Tangent::Zero();
  TangentMatrix first = TangentMatrix::Zero();
  TangentMatrix second = TangentMatrix::Zero();
};

/** Error alone. Positions and directions are about the second pose. */
Tangent
errorOf(const ErrorModel& model, const SolverPose& first, const SolverPose& second);

/** Error and derivatives. Positions and directions are about the second pose. */
void
linearizeError(const ErrorModel& model,
               const SolverPose& first,
               const SolverPose& second,
               ErrorValues& values);

} // namespace nurbs
} // namespace pcl
