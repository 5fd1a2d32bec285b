// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "judged_loop.h"

#include <Eigen/Core>

namespace pcl {
namespace nurbs {

/** How the covariance of a graph's poses enters the judgement of a loop. */
struct JointCovariance {
  Eigen::MatrixXd ends;   /**< of both ends of the loop together, in blocks */
  bool with_loop = false; /**< the loop is in the graph with weight 1, not 0 */
};

/** d^2 of a loop from what all other factors of a graph say together, at its estimates:
 * r^T (C + g J P J^T)^-1 r, C its own covariance, P that of the poses without it, and g
 * the loop's growth. If the loop is in the graph, r and P are those that there would be
 * without it, to first order. Directions in which the loop alone determines the poses
 * do not count. */
double
jointDistance(const PoseGraph& graph,
              const JudgedLoop& loop,
              const JointCovariance& covariance);

} // namespace nurbs
} // namespace pcl
