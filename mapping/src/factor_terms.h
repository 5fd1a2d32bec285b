// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "clique_tree.h"
#include "pose_graph_problem.h"

namespace pcl {
namespace nurbs {

/** One end of a factor in the normal equations. */
struct TermEnd {
  int variable = -1; /**< of the tree; -1: held, or there is none */
  bool planar = false;
};

/** Add a factor's normal equations at two poses, the right side being minus the
 * gradient of half of the cost. */
void
addFactor(const ProblemFactor& factor,
          const SolverPose& first,
          const SolverPose& second,
          const TermEnd& first_end,
          const TermEnd& second_end,
          FrontView& front);

/** A tree's solution for a pose as a tangent. */
Tangent
tangentFrom(const Eigen::Map<const Eigen::MatrixXd>& solution, bool planar);

} // namespace nurbs
} // namespace pcl
