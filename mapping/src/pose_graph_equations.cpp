// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "pose_graph_equations.h"

#include "elimination_order.h"
#include "factor_terms.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kLeastPivot = 1e-14;
constexpr double kFirstDamping = 1e-8;
constexpr double kMostDamping = 1e12;
constexpr double kVanishing = 1e-24; // of the cost: all residuals are rounding

} // namespace

PoseGraphEquations::PoseGraphEquations(PoseGraphProblem& problem)
    : problem_(problem), variables_(problem.poses.size(), -1)
{
  std::vector<int> order = eliminationOrder(problem);
  for (std::size_t k = 0; k < problem.poses.size(); ++k) {
    const int freedom = problem.freedom(static_cast<int>(k));
    if (freedom == 0)
      continue;
    variables_[k] = tree_.addVariable(freedom);
    poses_.push_back(static_cast<int>(k));
  }
  const auto variable = [this](int pose) {
    return pose < 0 ? -1 : variables_[static_cast<std::size_t>(pose)];
  };
  for (std::size_t k = 0; k < problem.factors.size(); ++k) {
    int a = variable(problem.factors[k].first);
    int b = variable(problem.factors[k].second);
    if (a < 0)
      std::swap(a, b);
    if (a < 0)
      continue;
    tree_.addTerm(a, b);
    factors_.push_back(static_cast<int>(k));
  }
  for (std::size_t k = 0; k < poses_.size(); ++k) {
    tree_.addTerm(static_cast<int>(k), -1);
    factors_.push_back(-1 - static_cast<int>(k));
  }
  for (int& pose : order)
    pose = variable(pose);
  tree_.build(order);
}

void
PoseGraphEquations::assemble(int term, FrontView& front)
{
  const int index = factors_[static_cast<std::size_t>(term)];
  if (index < 0) {
    const int variable = -1 - index;
    if (damping_ > 0.0) {
      const Tangent scaled = damping_ * diagonals_[static_cast<std::size_t>(variable)];
      const int size = tree_.dimension(variable);
      front.add(variable, variable, Eigen::MatrixXd(scaled.head(size).asDiagonal()));
    }
    return;
  }
  const ProblemFactor& factor = problem_.factors[static_cast<std::size_t>(index)];
  const auto end = [this](int pose) {
    return pose < 0 ? TermEnd()
                    : TermEnd{variables_[static_cast<std::size_t>(pose)],
                              problem_.planar[static_cast<std::size_t>(pose)] != 0};
  };
  addFactor(factor,
            problem_.pose(factor.first),
            problem_.pose(factor.second),
            end(factor.first),
            end(factor.second),
            front);
}

/** Diagonal of the undamped matrix. */
void
PoseGraphEquations::findDiagonals()
{
  diagonals_.assign(poses_.size(), Tangent::Zero());
  const auto add = [this](int pose, const TangentMatrix& jacobian) {
    if (problem_.freedom(pose) == 0)
      return;
    const Tangent squares = jacobian.colwise().squaredNorm().transpose();
    Tangent& sum = diagonals_[static_cast<std::size_t>(
        variables_[static_cast<std::size_t>(pose)])];
    if (problem_.freedom(pose) == 6)
      sum += squares;
    else
      for (std::size_t k = 0; k < kPlanarRows.size(); ++k)
        sum(static_cast<Eigen::Index>(k)) += squares(kPlanarRows[k]);
  };
  ErrorValues values;
  for (const ProblemFactor& factor : problem_.factors) {
    linearizeError(factor.model,
                   problem_.pose(factor.first),
                   problem_.pose(factor.second),
                   values);
    add(factor.first, factor.root * values.first);
    add(factor.second, factor.root * values.second);
  }
}

bool
PoseGraphEquations::factor(double damping)
{
  damping_ = damping;
  if (damping > 0.0)
    findDiagonals();
  return tree_.factor([this](int term, FrontView& front) { assemble(term, front); },
                      damping > 0.0 ? 0.0 : kLeastPivot);
}

std::vector<SolverPose>
PoseGraphEquations::step()
{
  tree_.solve(-1.0);
  std::vector<SolverPose> result = problem_.poses;
  for (std::size_t k = 0; k < poses_.size(); ++k) {
    const auto pose = static_cast<std::size_t>(poses_[k]);
    result[pose] = retract(
        result[pose],
        tangentFrom(tree_.solution(static_cast<int>(k)), problem_.planar[pose] != 0));
  }
  return result;
}

void
PoseGraphEquations::minimize(const PoseGraphOptions& options, PoseGraphSummary& summary)
{
  double cost = problem_.cost();
  const double vanishing = kVanishing * cost;
  double damping = 0.0; // none until a step fails
  double growth = 2.0;  // faster and faster while steps fail (Nielsen's rule)
  const auto strengthen = [&] {
    damping = damping > 0.0 ? growth * damping : kFirstDamping;
    growth *= 2.0;
  };
  while (!summary.converged && summary.iterations < options.max_iterations &&
         damping <= kMostDamping) {
    if (options.interrupted && options.interrupted())
      return;
    ++summary.iterations;
    if (!factor(damping)) {
      strengthen();
      continue;
    }
    std::vector<SolverPose> before = step();
    std::swap(before, problem_.poses);
    const double next = problem_.cost();
    const double gain = cost - next;
    if (!(gain >= -options.function_tolerance * cost) || !std::isfinite(next)) {
      problem_.poses = std::move(before);
      strengthen();
      continue;
    }
    summary.converged =
        std::abs(gain) <= options.function_tolerance * cost || next <= vanishing;
    cost = next;
    damping /= 3.0;
    growth = 2.0;
  }
  // no step of any length goes down: a minimum to rounding
  summary.converged = summary.converged || damping > kMostDamping;
}

void
PoseGraphEquations::invert()
{
  inverse_.emplace(tree_);
}

Eigen::MatrixXd
PoseGraphEquations::covarianceOf(const std::vector<int>& poses) const
{
  std::vector<int> variables;
  variables.reserve(poses.size());
  for (const int pose : poses)
    variables.push_back(variables_[static_cast<std::size_t>(pose)]);
  return inverse_->of(variables);
}

} // namespace nurbs
} // namespace pcl
