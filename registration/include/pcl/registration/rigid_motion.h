// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/nurbs/exports.h>

#include <Eigen/Geometry>

namespace pcl {
namespace nurbs {

/** \brief A small rigid motion, (translation x y z in metres, rotation x y z in
 * radians).
 *
 * The convention of the whole module, stated here once: the perturbation is on the
 * right, in the moved body's own axes, T <- T * exp(tangent), and translation comes
 * before rotation. Gradients, information matrices and covariances of a pose have their
 * rows in this order. (It is that of g2o's EDGE_SE3:QUAT but for its quaternion, half
 * of the rotation.)
 * \ingroup registration */
using Tangent = Eigen::Matrix<double, 6, 1>;

/** \brief A matrix over tangents, as a covariance or an information matrix. */
using TangentMatrix = Eigen::Matrix<double, 6, 6>;

/** \brief Exponential map of SE(3): the motion with constant twist \a tangent for one
 * unit of time (Barfoot, State Estimation for Robotics, eq. 7.80-7.86). */
PCL_NURBS_REGISTRATION_EXPORT Eigen::Isometry3d
exponential(const Tangent& tangent);

/** \brief Its inverse; the rotation is at most pi. */
PCL_NURBS_REGISTRATION_EXPORT Tangent
logarithm(const Eigen::Isometry3d& motion);

/** \brief The matrix of the cross product: crossMatrix(a) * b = a x b. */
PCL_NURBS_REGISTRATION_EXPORT Eigen::Matrix3d
crossMatrix(const Eigen::Vector3d& vector);

/** \brief How a perturbation looks on the other side of a motion: T exp(tangent) =
 * exp(adjoint(T) tangent) T (Barfoot, State Estimation for Robotics, eq. 7.45). A
 * covariance before a motion is A C A^T after it, with A = adjoint(motion.inverse()).
 */
PCL_NURBS_REGISTRATION_EXPORT TangentMatrix
adjoint(const Eigen::Isometry3d& motion);

/** \brief The same motion with the rotation made orthonormal, as products of many drift
 * away from it. */
PCL_NURBS_REGISTRATION_EXPORT Eigen::Isometry3d
orthonormal(const Eigen::Isometry3d& motion);

} // namespace nurbs
} // namespace pcl
