// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "joint_distance.h"

#include <Eigen/Eigenvalues>

namespace pcl {
namespace nurbs {
namespace {

/** The columns of a derivative by a pose that the pose is free to move in. */
Eigen::MatrixXd
freeColumns(const TangentMatrix& by_tangent, bool planar)
{
  if (!planar)
    return by_tangent;
  Eigen::MatrixXd result(6, 3);
  for (Eigen::Index k = 0; k < 3; ++k)
    result.col(k) = by_tangent.col(kPlanarRows[static_cast<std::size_t>(k)]);
  return result;
}

/** Whitened derivatives by both ends. */
Eigen::MatrixXd
jacobianOf(const PoseGraph& graph, const JudgedLoop& loop, const ErrorValues& values)
{
  const Eigen::MatrixXd first =
      freeColumns(values.first, graph.node(loop.measured.from).planar);
  const Eigen::MatrixXd second =
      freeColumns(values.second, graph.node(loop.measured.to).planar);
  Eigen::MatrixXd both(6, first.cols() + second.cols());
  both << first, second;
  return loop.factor.root.topRows(loop.factor.rows) * both;
}

} // namespace

double
jointDistance(const PoseGraph& graph,
              const JudgedLoop& loop,
              const JointCovariance& covariance)
{
  ErrorValues values;
  linearizeError(loop.factor.model,
                 toSolverPose(graph.node(loop.measured.from).T_world_node),
                 toSolverPose(graph.node(loop.measured.to).T_world_node),
                 values);
  const Eigen::MatrixXd jacobian = jacobianOf(graph, loop, values);
  const Eigen::MatrixXd spread = jacobian * covariance.ends * jacobian.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(spread);
  const Eigen::VectorXd components =
      parts.eigenvectors().transpose() *
      (loop.factor.root.topRows(loop.factor.rows) * values.error);
  constexpr double kDetermined = 1e-9; // share of the error that others see
  double sum = 0.0;
  for (Eigen::Index k = 0; k < components.size(); ++k) {
    // Without the loop the error is 1 / kept times as large, the variance value / kept.
    const double value = parts.eigenvalues()(k);
    const double kept = covariance.with_loop ? 1.0 - value : 1.0;
    if (kept > kDetermined)
      sum += components(k) * components(k) / (kept * (kept + loop.growth * value));
  }
  return sum;
}

} // namespace nurbs
} // namespace pcl
