// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "incremental_equations.h"

#include "elimination_order.h"
#include "factor_terms.h"

#include <algorithm>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kLeastPivot = 1e-14;
constexpr double kFirstDamping = 1e-9; // where poses are not determined
constexpr double kMostDamping = 1e3;

} // namespace

IncrementalEquations::IncrementalEquations(const PoseGraph& graph, PoseGraphCost form)
    : graph_(graph), form_(form), tree_(std::make_unique<CliqueTree>(1, true))
{
}

Tangent
IncrementalEquations::stepOf(int variable) const
{
  return tangentFrom(tree_->solution(variable), at(variable).planar);
}

SolverPose
IncrementalEquations::pose(NodeId id) const
{
  const int variable = variable_of_.at(id);
  return retract(at(variable).pose, stepOf(variable));
}

std::vector<NodeId>
IncrementalEquations::takeMoved()
{
  std::vector<NodeId> result(moved_.begin(), moved_.end());
  moved_.clear();
  return result;
}

void
IncrementalEquations::assemble(int index, FrontView& front) const
{
  const Term& term = terms_[static_cast<std::size_t>(index)];
  if (term.is_damping) {
    if (damping_ == 0.0)
      return;
    const int size = tree_->dimension(term.second);
    front.add(term.second,
              term.second,
              Eigen::MatrixXd(damping_ * at(term.second).scale *
                              Eigen::MatrixXd::Identity(size, size)));
    return;
  }
  const auto end = [this](int variable) {
    return variable < 0 ? TermEnd() : TermEnd{variable, at(variable).planar};
  };
  nurbs::addFactor(term.factor,
                   term.first < 0 ? term.first_pose : at(term.first).pose,
                   term.second < 0 ? term.second_pose : at(term.second).pose,
                   end(term.first),
                   end(term.second),
                   front);
}

/** Order, factor and solve for all variables, damped as far as it needs to be.
 * \throws std::runtime_error if nothing helps */
bool
IncrementalEquations::solveAll()
{
  VariablePairs pairs;
  std::vector<int> variables;
  std::vector<int> places(variables_.size(), -1);
  for (const auto& [id, variable] : variable_of_)
    variables.push_back(variable);
  std::sort(variables.begin(), variables.end());
  for (std::size_t k = 0; k < variables.size(); ++k)
    places[static_cast<std::size_t>(variables[k])] = static_cast<int>(k);
  for (const auto& [id, index] : term_of_) {
    const Term& term = terms_[static_cast<std::size_t>(index)];
    if (term.first >= 0 && term.second >= 0)
      pairs.emplace_back(places[static_cast<std::size_t>(term.first)],
                         places[static_cast<std::size_t>(term.second)]);
  }
  std::sort(pairs.begin(), pairs.end()); // the same whatever the order of the table
  std::vector<int> order = eliminationOrder(static_cast<int>(variables.size()), pairs);
  for (int& k : order)
    k = variables[static_cast<std::size_t>(k)];
  tree_->build(order);
  const auto add = [this](int term, FrontView& front) { assemble(term, front); };
  while (!tree_->factor(add, kLeastPivot)) {
    damping_ = damping_ == 0.0 ? kFirstDamping : 100.0 * damping_;
    if (damping_ > kMostDamping)
      throw std::runtime_error("the equations of the pose graph have no solution");
  }
  changed_.clear();
  tree_->solve(-1.0);
  return true;
}

IncrementalUpdate
IncrementalEquations::rebuild()
{
  tree_ = std::make_unique<CliqueTree>(1, true);
  variables_.clear();
  terms_.clear();
  variable_of_.clear();
  term_of_.clear();
  changed_.clear();
  far_.clear();
  damping_ = 0.0;
  for (const auto& [id, factor] : graph_.factors())
    addFactor(id);
  IncrementalUpdate result;
  result.all = true;
  result.eliminated = result.relinearized = result.solved = variable_of_.size();
  if (!variable_of_.empty())
    solveAll();
  for (const auto& [id, variable] : variable_of_)
    moved_.insert(id);
  return result;
}

void
IncrementalEquations::noteMoved(const IncrementalOptions& options)
{
  for (const int variable : tree_->movedVariables()) {
    const Tangent step = stepOf(variable);
    if (step.tail<3>().norm() > options.relinearize_rotation ||
        step.head<3>().norm() > options.relinearize_translation)
      far_.insert(variable);
    else
      far_.erase(variable);
    moved_.insert(at(variable).id);
  }
}

IncrementalUpdate
IncrementalEquations::update(const IncrementalOptions& options)
{
  if (parts_are_old_)
    findParts();
  IncrementalUpdate result;
  std::vector<int> again(far_.begin(), far_.end());
  std::sort(again.begin(), again.end());
  for (const int variable : again) {
    at(variable).pose = retract(at(variable).pose, stepOf(variable));
    tree_->clearSolution(variable);
  }
  far_.clear();
  result.relinearized = again.size();
  if (changed_.empty() && again.empty())
    return result;
  int eliminated = 0;
  const bool factored = tree_->update(
      changed_,
      again,
      [this](int term, FrontView& front) { assemble(term, front); },
      kLeastPivot,
      eliminated);
  changed_.clear();
  result.eliminated = static_cast<std::size_t>(eliminated);
  if (factored) {
    result.solved = static_cast<std::size_t>(tree_->solve(options.solve_threshold));
  }
  else {
    result.all = solveAll();
    result.eliminated = result.solved = variable_of_.size();
  }
  noteMoved(options);
  return result;
}

Eigen::MatrixXd
IncrementalEquations::covariance(const std::vector<NodeId>& ids) const
{
  std::vector<int> variables;
  variables.reserve(ids.size());
  for (const NodeId id : ids) {
    const auto found = variable_of_.find(id);
    if (found == variable_of_.end())
      throw std::invalid_argument("node " + std::to_string(id) +
                                  " is held or has no factor");
    variables.push_back(found->second);
  }
  return tree_->inverseOf(variables);
}

} // namespace nurbs
} // namespace pcl
