// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pose_graph_cost.h>

#include "pose_graph_problem.h"

#include <Eigen/Eigenvalues>

namespace pcl {
namespace nurbs {
namespace {

/** d / trace(block^-1); zero if there is no inverse. */
template <typename Block>
double
isotropic(const Block& block)
{
  constexpr double kRounding = 1e-12;
  const Eigen::SelfAdjointEigenSolver<Block> parts(block, Eigen::EigenvaluesOnly);
  const auto& values = parts.eigenvalues();
  if (!(values(0) > kRounding * values(values.size() - 1)))
    return 0.0;
  return static_cast<double>(block.rows()) / values.cwiseInverse().sum();
}

} // namespace

SeSyncWeights
seSyncWeights(const BetweenFactor& factor, bool planar)
{
  const TangentMatrix& information = factor.information;
  if (planar)
    return {information(5, 5),
            isotropic(Eigen::Matrix2d(information.topLeftCorner<2, 2>()))};
  // a file's rotational information is four times ours: 3 / (2 tr(C / 4))
  return {2.0 * isotropic(Eigen::Matrix3d(information.bottomRightCorner<3, 3>())),
          isotropic(Eigen::Matrix3d(information.topLeftCorner<3, 3>()))};
}

double
costOf(const PoseGraph& graph, PoseGraphCost form)
{
  return problemOf(graph, form).cost();
}

double
costOf(const PoseGraph& graph, FactorId id, PoseGraphCost form)
{
  const PoseFactor& factor = graph.factor(id);
  const ProblemFactor made = problemFactorOf(id, factor, graph, form);
  const std::vector<NodeId> nodes = nodesOf(factor.measurement);
  const SolverPose last = toSolverPose(graph.node(nodes.back()).T_world_node);
  if (nodes.size() == 1)
    return costOf(made, SolverPose(), last);
  return costOf(made, toSolverPose(graph.node(nodes.front()).T_world_node), last);
}

} // namespace nurbs
} // namespace pcl
