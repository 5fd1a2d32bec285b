// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "clique_tree.h"
#include "pose_graph_problem.h"

#include <pcl/mapping/pose_graph_solver.h>

namespace pcl {
namespace nurbs {

/** A graph's normal equations in a clique tree: Gauss-Newton steps with damping where
 * they fail (Levenberg-Marquardt), and parts of the inverse. */
class PoseGraphEquations {
public:
  /** \param[in] problem must outlive this; its poses are where the next linearisation
   * takes place */
  explicit PoseGraphEquations(PoseGraphProblem& problem);

  /** Linearise and factor, adding a share of the diagonal to it.
   * \return false if the matrix is not positive definite */
  bool
  factor(double damping);

  /** The poses one step further. */
  std::vector<SolverPose>
  step();

  /** Iterate to a minimum. */
  void
  minimize(const PoseGraphOptions& options, PoseGraphSummary& summary);

  /** Covariance of poses, by index, none of which is held: columns of the inverse of
   * the matrix that was factored. */
  Eigen::MatrixXd
  covarianceOf(const std::vector<int>& poses) const;

private:
  void
  assemble(int term, FrontView& front);

  void
  findDiagonals();

  PoseGraphProblem& problem_;
  CliqueTree tree_{1, false};
  std::vector<int> variables_; // by pose, -1 if held
  std::vector<int> poses_;     // by variable
  std::vector<int> factors_;   // by term; -1 - variable for its damping
  double damping_ = 0.0;
  std::vector<Tangent> diagonals_; // by variable, while there is damping
};

} // namespace nurbs
} // namespace pcl
