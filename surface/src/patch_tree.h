// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "bezier_extraction.h"

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A box with its own axes: thin around flat pieces however they are turned, so
 * distances to it are sharp lower bounds. */
struct OrientedBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); // one axis per row
  Eigen::Vector3d half = Eigen::Vector3d::Zero();

  double
  squaredDistance(const Eigen::Vector3d& point) const
  {
    const Eigen::Vector3d local = axes * (point - center);
    return (local.cwiseAbs() - half).cwiseMax(0.0).squaredNorm();
  }

  /** \brief Narrow [t_min, t_max] to the part of a line inside of the box.
   * \return false if nothing is left */
  bool
  clip(const Eigen::Vector3d& origin,
       const Eigen::Vector3d& direction,
       double& t_min,
       double& t_max) const;
};

/** \brief Binary hierarchy of oriented boxes over Bézier pieces, pieces split until
 * they are flat enough for their box to be thin. Immutable after construction. */
class PatchTree {
public:
  struct Node {
    OrientedBox box;
    int left = -1; // children, or -1 for a leaf
    int right = -1;
    int leaf = -1;
  };

  explicit PatchTree(std::vector<BezierPatch> pieces);

  const Node&
  root() const
  {
    return nodes_.front();
  }

  const Node&
  node(int i) const
  {
    return nodes_[static_cast<std::size_t>(i)];
  }

  /** \brief The Bézier piece of a leaf. */
  void
  loadLeaf(int leaf, BezierPatch& patch) const;

  /** \brief Length of the diagonal of the root box. */
  double
  size() const
  {
    return 2.0 * root().box.half.norm();
  }

private:
  struct Leaf {
    double u_min, u_max, v_min, v_max;
  };
  using Pieces = std::vector<BezierPatch>;

  int
  build(Pieces::iterator first, Pieces::iterator last);

  void
  buildPiece(int node, const BezierPatch& piece, int splits_left);

  int degree_u_;
  int degree_v_;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<Eigen::Vector4d> points_; // of all leaves, a fixed number for each
};

} // namespace nurbs
} // namespace pcl
