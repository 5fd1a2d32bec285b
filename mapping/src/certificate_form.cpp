// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "certificate_form.h"

#include "elimination_order.h"

#include <algorithm>

namespace pcl {
namespace nurbs {

CostForm::CostForm(int dimension,
                   std::vector<SolverPose> poses,
                   std::vector<CertificateEdge> edges)
    : dimension_(dimension),
      poses_(std::move(poses)),
      edges_(std::move(edges)),
      tree_(0, false)
{
  VariablePairs pairs;
  for (std::size_t k = 0; k < poses_.size(); ++k) // the first one's place is free
    tree_.addVariable(k == 0 ? dimension : dimension + 1);
  for (const CertificateEdge& edge : edges_) {
    tree_.addTerm(edge.first, edge.second);
    pairs.emplace_back(edge.first, edge.second);
  }
  for (std::size_t k = 0; k < poses_.size(); ++k)
    tree_.addTerm(static_cast<int>(k), -1);
  tree_.build(eliminationOrder(static_cast<int>(poses_.size()), pairs));
  findMultipliers();
}

bool
CostForm::isPositive(double shift)
{
  return tree_.factor(
      [&](int term, FrontView& front) {
        const auto count = static_cast<int>(edges_.size());
        if (term < count)
          addEdge(edges_[static_cast<std::size_t>(term)], front);
        else
          addMultiplier(term - count, shift, front);
      },
      0.0);
}

void
CostForm::findMultipliers()
{
  multipliers_.assign(poses_.size(), Eigen::MatrixXd::Zero(dimension_, dimension_));
  for (const CertificateEdge& edge : edges_) {
    const Eigen::MatrixXd first = rotationOf(edge.first);
    const Eigen::MatrixXd second = rotationOf(edge.second);
    const Eigen::MatrixXd turn = second - first * edge.rotation;
    const Eigen::VectorXd step = translationOf(edge.second) -
                                 translationOf(edge.first) - first * edge.translation;
    const double kappa = edge.weights.kappa;
    const double tau = edge.weights.tau;
    cost_ += kappa * turn.squaredNorm() + tau * step.squaredNorm();
    multipliers_[static_cast<std::size_t>(edge.first)] -=
        first.transpose() * (kappa * turn * edge.rotation.transpose() +
                             tau * step * edge.translation.transpose());
    multipliers_[static_cast<std::size_t>(edge.second)] +=
        kappa * second.transpose() * turn;
    largest_ = std::max({largest_, kappa + tau * edge.translation.squaredNorm(), tau});
  }
  for (Eigen::MatrixXd& multiplier : multipliers_)
    multiplier = (0.5 * (multiplier + multiplier.transpose())).eval();
}

void
CostForm::addEdge(const CertificateEdge& edge, FrontView& front) const
{
  const int d = dimension_;
  const double tau = edge.weights.tau;
  Eigen::MatrixXd first = Eigen::MatrixXd::Zero(d + 1, d + 1);
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(d + 1, d + 1);
  Eigen::MatrixXd cross = Eigen::MatrixXd::Zero(d + 1, d + 1); // first's rows
  second.topLeftCorner(d, d).diagonal().setConstant(edge.weights.kappa);
  second(d, d) = tau;
  first = second;
  first.topLeftCorner(d, d) += tau * edge.translation * edge.translation.transpose();
  first.topRightCorner(d, 1) = tau * edge.translation;
  first.bottomLeftCorner(1, d) = tau * edge.translation.transpose();
  cross.topLeftCorner(d, d) = -edge.weights.kappa * edge.rotation;
  cross.topRightCorner(d, 1) = -tau * edge.translation;
  cross(d, d) = -tau;
  const int a = tree_.dimension(edge.first);
  const int b = tree_.dimension(edge.second);
  front.add(edge.first, edge.first, Eigen::MatrixXd(first.topLeftCorner(a, a)));
  front.add(edge.second, edge.second, Eigen::MatrixXd(second.topLeftCorner(b, b)));
  front.add(edge.first, edge.second, Eigen::MatrixXd(cross.topLeftCorner(a, b)));
}

void
CostForm::addMultiplier(int pose, double shift, FrontView& front) const
{
  const int size = tree_.dimension(pose);
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(size, size);
  block.topLeftCorner(dimension_, dimension_) =
      shift * Eigen::MatrixXd::Identity(dimension_, dimension_) -
      multipliers_[static_cast<std::size_t>(pose)];
  front.add(pose, pose, block);
}

} // namespace nurbs
} // namespace pcl
