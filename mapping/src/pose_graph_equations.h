// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "clique_inverse.h"
#include "pose_graph_problem.h"

#include <pcl/mapping/pose_graph_solver.h>

#include <optional>

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

  /** Invert the matrix that was factored, for covarianceOf(). */
  void
  invert();

  /** Covariance of poses, by index, none of which is held. */
  Eigen::MatrixXd
  covarianceOf(const std::vector<int>& poses) const;

private:
  void
  assemble(int term, FrontView& front);

  void
  findDiagonals();

  PoseGraphProblem& problem_;
  CliqueTree tree_{1, false};
  std::optional<CliqueInverse> inverse_;
  std::vector<int> variables_; // by pose, -1 if held
  std::vector<int> poses_;     // by variable
  std::vector<int> factors_;   // by term; -1 - variable for its damping
  double damping_ = 0.0;
  std::vector<Tangent> diagonals_; // by variable, while there is damping
};

} // namespace nurbs
} // namespace pcl
