// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "pose_graph_problem.h"

#include <Eigen/SparseCholesky>

namespace pcl {
namespace nurbs {

/** How far loops are from what all other factors of a graph say together, at its
 * estimates: the normal equations are factorised once, and the covariance of each loop's
 * error comes from two or twelve sparse forward solutions. */
class JointDistances {
public:
  /** \throws std::runtime_error if the normal equations have no unique solution */
  explicit JointDistances(const PoseGraph& graph);

  /** d^2 of a loop's error: r^T (C + J P J^T)^-1 r for a loop of weight zero, C its own
   * covariance and P that of the poses. For one that is in the graph, C - J P J^T: the
   * distance it would have if the graph were solved without it, to first order.
   * Directions in which the loop alone determines the poses do not count. */
  double
  squaredDistance(const ProblemFactor& loop, bool in_graph) const;

  struct Query {
    const ProblemFactor* loop;
    bool in_graph;
  };

  /** Of several loops, in so many threads. */
  std::vector<double>
  squaredDistances(const std::vector<Query>& queries, int threads) const;

private:
  using Sparse = Eigen::SparseMatrix<double>;

  void
  factorize();
  /** J P J^T for whitened derivatives by the poses of both ends. */
  TangentMatrix
  projected(const ProblemFactor& loop, const ErrorValues& values) const;

  PoseGraphProblem problem_;
  std::vector<int> columns_; // of each pose, -1 for none
  Eigen::SimplicialLLT<Sparse, Eigen::Lower> cholesky_;
  Sparse lower_;
};

} // namespace nurbs
} // namespace pcl
