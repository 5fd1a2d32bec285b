// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>
#include <pcl/registration/rigid_motion.h>

#include <cstdint>
#include <variant>

namespace pcl {
namespace nurbs {

/** \brief Name of a node, chosen by the user: any number.
 * \ingroup mapping */
using NodeId = std::uint64_t;

/** \brief Name of a factor, given by the graph and never given again.
 * \ingroup mapping */
using FactorId = std::uint64_t;

/** \name Factors of a pose graph
 *
 * A node's pose T_world_node takes coordinates of the node's frame to the world's.
 * Errors are measured in metres and radians, and information matrices (inverse
 * covariances) have their rows in the order of Tangent: translation, then rotation. An
 * information matrix is symmetric and positive semidefinite; zero in a direction means
 * that nothing is known about it. A measurement made in another frame than the node's
 * (of a camera, of an antenna) is brought into it first: T_from_to = T_from_sensor *
 * measured * T_to_sensor^-1, with the information rotated accordingly; position factors
 * know their antenna's place themselves.
 *
 * The error of a measured pose Z of X is that of E = Z^-1 X: its translation (in Z's
 * frame) and twice the vector part of its unit quaternion, w >= 0, which is 2 sin(angle
 * / 2) along the axis. In planar graphs it is the angle itself. To first order, both
 * are Tangent's.
 * \{ */

/** \brief Pose of node \a to as seen from node \a from, X = T_world_from^-1 T_world_to:
 * odometry, a loop. */
struct BetweenFactor {
  NodeId from = 0;
  NodeId to = 0;
  Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity();
  TangentMatrix information = TangentMatrix::Identity();
};

/** \brief The pose itself, as known. With zero information of the translation: the
 * orientation, as of a compass. */
struct PriorFactor {
  NodeId node = 0;
  Eigen::Isometry3d T_world_node = Eigen::Isometry3d::Identity();
  TangentMatrix information = TangentMatrix::Identity();
};

/** \brief Where a point of the node's frame is in the world, as from satellites: the
 * error is T_world_node * point_node - point_world, along the world's axes. */
struct PositionFactor {
  NodeId node = 0;
  Eigen::Vector3d point_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_node = Eigen::Vector3d::Zero(); /**< the antenna */
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
};

/** \brief A direction of the world seen in the node's frame, as of gravity by
 * accelerometers: the error is R_world_node^T * direction_world - direction_node, both
 * of unit length. */
struct DirectionFactor {
  NodeId node = 0;
  Eigen::Vector3d direction_world = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d direction_node = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
};

/** \} */

/** \brief Any measurement. \ingroup mapping */
using Measurement =
    std::variant<BetweenFactor, PriorFactor, PositionFactor, DirectionFactor>;

/** \brief A measurement in a graph.
 * \ingroup mapping */
struct PoseFactor {
  Measurement measurement;
  /** Its information counts so many times; 0 switches it off. Robust methods set it. */
  double weight = 1.0;
};

/** \brief A factor's error at poses of its nodes, and how it changes.
 * \ingroup mapping */
struct FactorLinearization {
  /** Error, metres and radians; 3 or 6 rows. */
  Eigen::VectorXd error;
  /** Change of the error with the perturbation T <- T * exp(tangent) of the pose of the
   * first node (from, node) and of the second (to; empty for the others). */
  Eigen::MatrixXd jacobian_first;
  Eigen::MatrixXd jacobian_second;
};

/** \brief Error and derivatives of a measurement.
 * \param[in] measurement a factor
 * \param[in] T_world_first pose of its first node \param[in] T_world_second pose of its
 * second node, not used if it has one only */
PCL_NURBS_MAPPING_EXPORT FactorLinearization
linearize(const Measurement& measurement,
          const Eigen::Isometry3d& T_world_first,
          const Eigen::Isometry3d& T_world_second);

} // namespace nurbs
} // namespace pcl
