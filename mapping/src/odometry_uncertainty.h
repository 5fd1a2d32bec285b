// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph.h>

#include <optional>
#include <set>
#include <vector>

namespace pcl {
namespace nurbs {

/** How many times smaller errors are than information matrices say. */
struct NoiseScale {
  double translation = 1.0;
  double rotation = 1.0;

  /** A covariance with its rows and columns scaled. */
  TangentMatrix
  applyTo(const TangentMatrix& covariance) const;
};

/** Inverse of an information matrix; directions of which it says nothing get a variance
 * that is large beside the others'. In the plane, about x, y and the turn only. */
TangentMatrix
covarianceOf(const TangentMatrix& information, bool planar);

/** Rows and columns of what moves in the plane: x, y and the turn. */
Eigen::Matrix3d
planarPart(const TangentMatrix& matrix);

/** A relative pose and how well it is known. */
struct UncertainMotion {
  Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity();
  /** Of the tangent on its right. */
  TangentMatrix covariance = TangentMatrix::Zero();
};

/** The same motion backwards. */
UncertainMotion
reversed(const UncertainMotion& motion);

/** d^2 of an error: in the plane of 3 numbers, in space of 6. */
double
squaredDistance(const Tangent& error, const TangentMatrix& covariance, bool planar);

/** Motions along trusted between factors of nodes whose names follow each other, with
 * covariances propagated to first order. Sums from the start make any stretch O(1). */
class OdometryUncertainty {
public:
  /** \param[in] distrusted factors to leave out \param[in] scale of all errors
   * \param[in] correlated errors may all go the same way, as a wrong scale's do: the
   * covariance is n times what n independent ones add up to */
  OdometryUncertainty(const PoseGraph& graph,
                      const std::set<FactorId>& distrusted,
                      const NoiseScale& scale = {},
                      bool correlated = false);

  /** From node to node; nothing if odometry does not join them. */
  std::optional<UncertainMotion>
  motion(NodeId from, NodeId to) const;

  /** Position of a node along the chain, for comparing lengths of stretches. */
  std::size_t
  indexOf(NodeId id) const;

private:
  struct Place {
    std::size_t stretch = 0; // rises where the odometry is interrupted
    Eigen::Isometry3d T_start_node = Eigen::Isometry3d::Identity();
    TangentMatrix covariance = TangentMatrix::Zero(); // in the start's frame
  };

  bool correlated_;
  std::vector<NodeId> names_;
  std::vector<Place> places_;
};

} // namespace nurbs
} // namespace pcl
