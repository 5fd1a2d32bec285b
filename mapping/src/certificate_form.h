// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "clique_tree.h"
#include "pose_graph_problem.h"

#include <vector>

namespace pcl {
namespace nurbs {

/** A between factor in SE-Sync's cost, about nodes of one part by their places in it.
 */
struct CertificateEdge {
  int first;
  int second;
  SeSyncWeights weights;
  Eigen::MatrixXd rotation; // d x d
  Eigen::VectorXd translation;
};

/** The quadratic form of SE-Sync's cost over (R_1 t_1 R_2 t_2 ...), one row of it, for
 * one part of a graph with n poses. */
class CostForm {
public:
  /** \param[in] dimension 2 or 3 \param[in] poses where Lambda is taken */
  CostForm(int dimension,
           std::vector<SolverPose> poses,
           std::vector<CertificateEdge> edges);

  double
  cost() const
  {
    return cost_;
  }

  /** Sum of the traces of Lambda. */
  double
  trace() const
  {
    double sum = 0.0;
    for (const Eigen::MatrixXd& multiplier : multipliers_)
      sum += multiplier.trace();
    return sum;
  }

  double
  largestEntry() const
  {
    return largest_;
  }

  double
  rotationRows() const
  {
    return static_cast<double>(poses_.size()) * dimension_;
  }

  /** Whether the form minus Lambda plus a share of the identity on the rotations is
   * positive definite. */
  bool
  isPositive(double shift);

private:
  Eigen::MatrixXd
  rotationOf(int pose) const
  {
    return poses_[static_cast<std::size_t>(pose)]
        .rotation.toRotationMatrix()
        .topLeftCorner(dimension_, dimension_);
  }

  Eigen::VectorXd
  translationOf(int pose) const
  {
    return poses_[static_cast<std::size_t>(pose)].translation.head(dimension_);
  }

  void
  findMultipliers();

  void
  addEdge(const CertificateEdge& edge, FrontView& front) const;

  void
  addMultiplier(int pose, double shift, FrontView& front) const;

  int dimension_;
  std::vector<SolverPose> poses_;
  std::vector<CertificateEdge> edges_;
  CliqueTree tree_;
  std::vector<Eigen::MatrixXd> multipliers_;
  double cost_ = 0.0;
  double largest_ = 0.0;
};

} // namespace nurbs
} // namespace pcl
