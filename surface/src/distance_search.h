// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "patch_tree.h"

#include <Eigen/Core>

#include <functional>
#include <limits>

namespace pcl {
namespace nurbs {

/** \brief A local minimum of the distance to a point. */
struct FootPoint {
  double u = 0.0;
  double v = 0.0;
  double squared_distance = std::numeric_limits<double>::infinity();
  bool converged = false;
};

/** \brief Finds the global minimum of the distance from a point to a set of Bézier
 * pieces by branch and bound.
 *
 * Boxes prune first. In what is left the function |A - w p|^2 - d^2 w^2 is written in
 * Bernstein form, where (A, w) is the homogeneous piece and d the best distance so far:
 * if no coefficient is negative, nothing nearer is inside; if the function is convex,
 * the local minimum inside is the only one. Otherwise the piece is halved. The distance
 * returned is the smallest one to a relative 1e-10.
 */
class DistanceSearch {
public:
  /** \brief Local descent on the true distance from a start parameter. */
  using Descend = std::function<FootPoint(double u, double v)>;

  DistanceSearch(const PatchTree& tree, const Eigen::Vector3d& point, Descend descend);

  FootPoint
  run();

private:
  void
  visit(const PatchTree::Node& node);

  void
  examine(const BezierPatch& patch, int splits_left);

  void
  improve(double u, double v);

  double
  bound() const;

  const PatchTree& tree_;
  Eigen::Vector3d point_;
  Descend descend_;
  FootPoint best_;
  FootPoint latest_;
};

} // namespace nurbs
} // namespace pcl
