// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pose_graph_solver.h>

#include "elimination_order.h"
#include "pose_graph_problem.h"

#include <Eigen/SVD>
#include <Eigen/SparseCholesky>

#include <limits>

namespace pcl {
namespace nurbs {
namespace {

/** A between factor or a prior (from the world), as two linear equations. */
struct LinearEdge {
  int first; // -1: the world
  int second;
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  SeSyncWeights weights;
};

/** Blocks of normal equations over the poses that are not held, in the order of
 * elimination. */
class BlockSystem {
public:
  BlockSystem(std::size_t variables, int block)
      : block_(block),
        right_(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(variables) * block, 3))
  {
  }

  template <typename Matrix>
  void
  add(int row, int column, const Matrix& matrix)
  {
    if (row < column) {
      add(column, row, matrix.transpose().eval());
      return;
    }
    for (int i = 0; i < block_; ++i)
      for (int j = 0; j < block_; ++j)
        if (row != column || i >= j)
          entries_.emplace_back(row * block_ + i, column * block_ + j, matrix(i, j));
  }

  template <typename Matrix>
  void
  addRight(int row, const Matrix& matrix)
  {
    right_.middleRows(row * block_, block_) += matrix;
  }

  /** Empty if there is no unique solution. */
  Eigen::MatrixXd
  solve() const
  {
    using Sparse = Eigen::SparseMatrix<double>;
    Sparse matrix(right_.rows(), right_.rows());
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>>
        factor(matrix);
    if (factor.info() != Eigen::Success)
      return {};
    return factor.solve(right_);
  }

private:
  int block_;
  Eigen::MatrixXd right_;
  std::vector<Eigen::Triplet<double>> entries_;
};

Eigen::Matrix3d
nearestRotation(const Eigen::Matrix3d& matrix)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> parts(
      matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  signs(2) = (parts.matrixU() * parts.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return parts.matrixU() * signs.asDiagonal() * parts.matrixV().transpose();
}

class ChordalRelaxation {
public:
  ChordalRelaxation(const PoseGraph& graph, PoseGraphProblem& problem)
      : problem_(problem), places_(problem.poses.size(), -1)
  {
    holdOnePoseOfEachPart(graph);
    int place = 0;
    for (const int k : eliminationOrder(problem))
      places_[static_cast<std::size_t>(k)] = place++;
    variables_ = static_cast<std::size_t>(place);
    for (const ProblemFactor& factor : problem.factors)
      addEdge(graph, factor);
  }

  void
  run()
  {
    solveRotations();
    solveTranslations();
  }

private:
  /** What only positions or directions tie down has no rotation in linear equations. */
  void
  holdOnePoseOfEachPart(const PoseGraph& graph)
  {
    for (const std::vector<NodeId>& part : graph.components()) {
      bool tied = false;
      for (const NodeId id : part)
        tied = tied || problem_.held[indexOf(problem_.names, id)] != 0 ||
               hasPrior(graph, id);
      if (!tied)
        problem_.held[indexOf(problem_.names, part.front())] = 1;
    }
  }

  static bool
  hasPrior(const PoseGraph& graph, NodeId id)
  {
    for (const FactorId factor : graph.node(id).factors)
      if (graph.factor(factor).weight > 0.0 &&
          std::holds_alternative<PriorFactor>(graph.factor(factor).measurement))
        return true;
    return false;
  }

  void
  addEdge(const PoseGraph& graph, const ProblemFactor& factor)
  {
    const PoseFactor& source = graph.factor(factor.id);
    BetweenFactor as_between;
    if (const auto* between = std::get_if<BetweenFactor>(&source.measurement))
      as_between = *between;
    else if (const auto* prior = std::get_if<PriorFactor>(&source.measurement))
      as_between.information = prior->information;
    else
      return;
    LinearEdge edge{
        factor.first,
        factor.second,
        factor.model.measured.rotation.toRotationMatrix(),
        factor.model.measured.translation,
        seSyncWeights(as_between,
                      problem_.planar[static_cast<std::size_t>(factor.second)] != 0)};
    edge.weights.kappa *= source.weight;
    edge.weights.tau *= source.weight;
    edges_.push_back(edge);
  }

  int
  place(int pose) const
  {
    return pose < 0 ? -1 : places_[static_cast<std::size_t>(pose)];
  }

  void
  solveRotations()
  {
    BlockSystem system(variables_, 3);
    const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
    for (const LinearEdge& edge : edges_) { // X_j - R_ij^T X_i = 0 with X = R^T
      const double weight = edge.weights.kappa;
      const int i = place(edge.first);
      const int j = place(edge.second);
      if (i >= 0)
        system.add(i, i, weight * identity);
      if (j >= 0)
        system.add(j, j, weight * identity);
      if (i >= 0 && j >= 0)
        system.add(j, i, (-weight * edge.rotation.transpose()).eval());
      else if (j >= 0)
        system.addRight(j,
                        weight * (rotationOf(edge.first) * edge.rotation).transpose());
      else if (i >= 0)
        system.addRight(i,
                        weight * edge.rotation * rotationOf(edge.second).transpose());
    }
    const Eigen::MatrixXd solution = system.solve();
    if (solution.size() == 0)
      return;
    for (std::size_t k = 0; k < places_.size(); ++k)
      if (places_[k] >= 0)
        problem_.poses[k].rotation =
            nearestRotation(solution.middleRows<3>(3 * places_[k]).transpose());
  }

  Eigen::Matrix3d
  rotationOf(int pose) const
  {
    return problem_.pose(pose).rotation.toRotationMatrix();
  }

  void
  solveTranslations()
  {
    BlockSystem system(variables_, 1);
    for (const LinearEdge& edge : edges_) { // t_j - t_i = R_i t_ij
      const Eigen::Matrix<double, 1, 1> weight(edge.weights.tau);
      const int i = place(edge.first);
      const int j = place(edge.second);
      const Eigen::RowVector3d step =
          weight(0) *
          (problem_.pose(edge.first).rotation * edge.translation).transpose();
      const auto known = [&](int pose) -> Eigen::RowVector3d {
        return weight(0) * problem_.pose(pose).translation.transpose();
      };
      if (i >= 0) {
        system.add(i, i, weight);
        system.addRight(i, -step);
      }
      if (j >= 0) {
        system.add(j, j, weight);
        system.addRight(j, step);
      }
      if (i >= 0 && j >= 0)
        system.add(j, i, (-weight).eval());
      else if (j >= 0)
        system.addRight(j, known(edge.first));
      else if (i >= 0)
        system.addRight(i, known(edge.second));
    }
    const Eigen::MatrixXd solution = system.solve();
    if (solution.size() == 0)
      return;
    for (std::size_t k = 0; k < places_.size(); ++k)
      if (places_[k] >= 0)
        problem_.poses[k].translation = solution.row(places_[k]).transpose();
  }

  PoseGraphProblem& problem_;
  std::vector<int> places_; // in the order of elimination; -1 for held poses
  std::size_t variables_ = 0;
  std::vector<LinearEdge> edges_;
};

} // namespace

void
initializeChordal(PoseGraph& graph, PoseGraphCost form)
{
  completeEstimates(graph);
  PoseGraphProblem problem = problemOf(graph, form);
  ChordalRelaxation(graph, problem).run();
  writeBack(problem, graph);
}

} // namespace nurbs
} // namespace pcl
