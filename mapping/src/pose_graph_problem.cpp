// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "pose_graph_problem.h"

#include "factor_models.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

/** Rows R with R^T R = information, no more than its rank. */
void
setRoot(const Eigen::MatrixXd& information, double weight, ProblemFactor& factor)
{
  const Eigen::Index size = information.rows();
  const double scale = std::sqrt(weight);
  const Eigen::LLT<Eigen::MatrixXd> triangle(information);
  if (triangle.info() == Eigen::Success) {
    factor.root.topLeftCorner(size, size) = scale * Eigen::MatrixXd(triangle.matrixU());
    factor.rows = static_cast<int>(size);
    return;
  }
  constexpr double kRounding = 1e-12;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(information);
  const double least = kRounding * parts.eigenvalues()(size - 1);
  for (Eigen::Index k = 0; k < size; ++k)
    if (parts.eigenvalues()(k) > least)
      factor.root.row(factor.rows++).head(size) =
          scale * std::sqrt(parts.eigenvalues()(k)) *
          parts.eigenvectors().col(k).transpose();
}

void
setSeSyncRoot(const BetweenFactor& between,
              double weight,
              bool planar,
              ProblemFactor& f)
{
  const SeSyncWeights weights = seSyncWeights(between, planar);
  Tangent diagonal;
  diagonal << Eigen::Vector3d::Constant(std::sqrt(weight * weights.tau)),
      Eigen::Vector3d::Constant(std::sqrt(2.0 * weight * weights.kappa));
  if (planar) {
    f.rows = 3;
    for (int k = 0; k < 3; ++k)
      f.root(k, kPlanarRows[static_cast<std::size_t>(k)]) =
          diagonal(kPlanarRows[static_cast<std::size_t>(k)]);
  }
  else {
    f.rows = 6;
    f.root = diagonal.asDiagonal();
  }
}

bool
isPlanar(const Measurement& measurement, const PoseGraph& graph)
{
  const std::vector<NodeId> nodes = nodesOf(measurement);
  return std::all_of(
      nodes.begin(), nodes.end(), [&](NodeId id) { return graph.node(id).planar; });
}

/** Hold what no factor is about, and a pose of each part that nothing ties down. */
void
holdPoses(const PoseGraph& graph, PoseGraphProblem& problem)
{
  std::vector<char> tied(problem.poses.size(), 0);
  std::vector<char> used(problem.poses.size(), 0);
  for (const ProblemFactor& factor : problem.factors) {
    const auto second = static_cast<std::size_t>(factor.second);
    used[second] = 1;
    if (factor.first < 0)
      tied[second] = 1;
    else
      used[static_cast<std::size_t>(factor.first)] = 1;
  }
  for (const std::vector<NodeId>& part : graph.components()) {
    bool is_tied = false;
    for (const NodeId id : part) {
      const std::size_t k = indexOf(problem.names, id);
      is_tied = is_tied || tied[k] != 0 || problem.held[k] != 0;
      if (used[k] == 0)
        problem.held[k] = 1;
    }
    const std::size_t first = indexOf(problem.names, part.front());
    if (!is_tied && used[first] != 0) {
      problem.held[first] = 1;
      problem.anchors.push_back(part.front());
    }
    ++problem.components;
  }
}

} // namespace

std::size_t
indexOf(const std::vector<NodeId>& names, NodeId id)
{
  if (id < names.size() && names[id] == id) // names are often 0, 1, 2, ...
    return id;
  const auto place = std::lower_bound(names.begin(), names.end(), id);
  if (place == names.end() || *place != id)
    throw std::out_of_range("there is no node " + std::to_string(id));
  return static_cast<std::size_t>(place - names.begin());
}

double
costOf(const ProblemFactor& factor, const SolverPose& first, const SolverPose& second)
{
  return (factor.root.topRows(factor.rows) * errorOf(factor.model, first, second))
      .squaredNorm();
}

double
PoseGraphProblem::cost() const
{
  double sum = 0.0;
  for (const ProblemFactor& factor : factors)
    sum += costOf(factor, pose(factor.first), pose(factor.second));
  return sum;
}

ProblemFactor
problemFactorOf(FactorId id,
                const PoseFactor& factor,
                const PoseGraph& graph,
                PoseGraphCost form)
{
  ProblemFactor result;
  result.id = id;
  result.model = errorModelOf(factor.measurement);
  const bool planar = isPlanar(factor.measurement, graph);
  const auto* between = std::get_if<BetweenFactor>(&factor.measurement);
  if (between != nullptr && form == PoseGraphCost::SeSync) {
    setSeSyncRoot(*between, factor.weight, planar, result);
    return result;
  }
  if (planar && result.model.kind == ErrorKind::Pose)
    result.model.kind = ErrorKind::PlaneAngle;
  std::visit(
      [&](const auto& measured) {
        setRoot(measured.information, factor.weight, result);
      },
      factor.measurement);
  return result;
}

PoseGraphProblem
problemOf(const PoseGraph& graph, PoseGraphCost form)
{
  PoseGraphProblem problem;
  for (const auto& [id, node] : graph.nodes()) {
    if (!node.has_estimate && !node.factors.empty())
      throw std::invalid_argument("node " + std::to_string(id) + " has no pose");
    problem.names.push_back(id);
    problem.poses.push_back(toSolverPose(node.T_world_node));
    problem.planar.push_back(node.planar ? 1 : 0);
    problem.held.push_back(node.fixed ? 1 : 0);
  }
  problem.factors.reserve(graph.factors().size());
  for (const auto& [id, factor] : graph.factors()) {
    if (factor.weight == 0.0)
      continue;
    problem.factors.push_back(problemFactorOf(id, factor, graph, form));
    const std::vector<NodeId> nodes = nodesOf(factor.measurement);
    ProblemFactor& made = problem.factors.back();
    made.second = static_cast<int>(indexOf(problem.names, nodes.back()));
    if (nodes.size() == 2)
      made.first = static_cast<int>(indexOf(problem.names, nodes.front()));
  }
  holdPoses(graph, problem);
  return problem;
}

void
writeBack(const PoseGraphProblem& problem, PoseGraph& graph)
{
  for (std::size_t k = 0; k < problem.names.size(); ++k) {
    if (problem.held[k] != 0)
      continue;
    const SolverPose before = toSolverPose(graph.node(problem.names[k]).T_world_node);
    if (before.translation !=
            problem.poses[k].translation || // else not one bit changes
        before.rotation.coeffs() != problem.poses[k].rotation.coeffs())
      graph.setPose(problem.names[k], toIsometry(problem.poses[k]));
  }
}

} // namespace nurbs
} // namespace pcl
