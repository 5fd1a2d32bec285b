// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

// Which nodes are variables, which factors are terms, and the anchors of parts.

#include "incremental_equations.h"

#include <algorithm>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kAnchorStrength = 1e3; // against the node's first factor

} // namespace

int
IncrementalEquations::addTerm(Term term)
{
  const int a = term.first >= 0 ? term.first : term.second;
  const int b = term.first >= 0 ? term.second : -1;
  const int index = tree_->addTerm(a, b);
  terms_.push_back(std::move(term));
  changed_.push_back(a);
  if (b >= 0)
    changed_.push_back(b);
  return index;
}

void
IncrementalEquations::removeTerm(int index)
{
  const Term& term = terms_[static_cast<std::size_t>(index)];
  for (const int variable : {term.first, term.second})
    if (variable >= 0)
      changed_.push_back(variable);
  tree_->removeTerm(index);
}

/** The variable of a node, made at its first factor. */
int
IncrementalEquations::variableFor(NodeId id, const ProblemFactor& factor)
{
  const auto found = variable_of_.find(id);
  if (found != variable_of_.end())
    return found->second;
  const PoseNode& node = graph_.node(id);
  const int variable = tree_->addVariable(node.planar ? 3 : 6);
  variable_of_.emplace(id, variable);
  variables_.emplace_back();
  Variable& made = variables_.back();
  made.id = id;
  made.pose = toSolverPose(node.T_world_node);
  made.planar = node.planar;
  made.scale = factor.root.cwiseAbs().maxCoeff();
  made.scale *= made.scale;
  made.part = variable;
  Term damping;
  damping.second = variable;
  damping.is_damping = true;
  made.damping = addTerm(damping);
  setAnchor(variable);
  return variable;
}

void
IncrementalEquations::setAnchor(int variable)
{
  Term anchor;
  anchor.second = variable;
  anchor.factor.model.measured = at(variable).pose;
  anchor.factor.root =
      kAnchorStrength * std::sqrt(at(variable).scale) * TangentMatrix::Identity();
  anchor.factor.rows = 6;
  at(variable).anchor = addTerm(anchor);
}

void
IncrementalEquations::dropAnchor(int part)
{
  if (at(part).anchor >= 0)
    removeTerm(at(part).anchor);
  at(part).anchor = -1;
}

int
IncrementalEquations::partOf(int variable)
{
  int root = variable;
  while (at(root).part != root)
    root = at(root).part;
  while (at(variable).part != root)
    variable = std::exchange(at(variable).part, root);
  return root;
}

/** The older part keeps its anchor. */
void
IncrementalEquations::join(int a, int b)
{
  a = partOf(a);
  b = partOf(b);
  if (a == b)
    return;
  const int root = std::min(a, b);
  const int other = std::max(a, b);
  at(other).part = root;
  dropAnchor(other);
  if (at(other).tied)
    tie(root);
}

void
IncrementalEquations::tie(int variable)
{
  const int root = partOf(variable);
  at(root).tied = true;
  dropAnchor(root);
}

/** Factors have been removed: parts may have come apart. */
void
IncrementalEquations::findParts()
{
  parts_are_old_ = false;
  for (const auto& [id, variable] : variable_of_) {
    dropAnchor(variable);
    at(variable).part = variable;
    at(variable).tied = false;
  }
  std::vector<int> tied;
  for (const auto& [id, index] : term_of_) {
    const Term& term = terms_[static_cast<std::size_t>(index)];
    if (term.first >= 0 && term.second >= 0)
      join(term.first, term.second);
    else
      tied.push_back(std::max(term.first, term.second));
  }
  for (const int variable : tied)
    tie(variable);
  for (const auto& [id, variable] : variable_of_)
    if (partOf(variable) == variable && !at(variable).tied)
      setAnchor(variable);
}

void
IncrementalEquations::addFactor(FactorId id)
{
  const PoseFactor& factor = graph_.factor(id);
  if (factor.weight == 0.0)
    return;
  Term term;
  term.factor = problemFactorOf(id, factor, graph_, form_);
  const std::vector<NodeId> nodes = nodesOf(factor.measurement);
  const auto connect = [&](NodeId node, int& variable, SolverPose& held) {
    if (graph_.node(node).fixed)
      held = toSolverPose(graph_.node(node).T_world_node);
    else {
      variable = variableFor(node, term.factor);
      ++at(variable).factors;
    }
  };
  if (nodes.size() == 2)
    connect(nodes.front(), term.first, term.first_pose);
  connect(nodes.back(), term.second, term.second_pose);
  if (term.first < 0 && term.second < 0)
    return;
  if (term.first >= 0 && term.second >= 0)
    join(term.first, term.second);
  else
    tie(std::max(term.first, term.second));
  term_of_.emplace(id, addTerm(std::move(term)));
}

void
IncrementalEquations::removeFactor(FactorId id)
{
  const auto found = term_of_.find(id);
  if (found == term_of_.end())
    return;
  const Term term = terms_[static_cast<std::size_t>(found->second)];
  removeTerm(found->second);
  term_of_.erase(found);
  parts_are_old_ = true;
  for (const int variable : {term.first, term.second})
    if (variable >= 0 && --at(variable).factors == 0)
      dropVariable(variable);
}

void
IncrementalEquations::dropVariable(int variable)
{
  dropAnchor(variable);
  removeTerm(at(variable).damping);
  tree_->removeVariable(variable);
  variable_of_.erase(at(variable).id);
  far_.erase(variable);
  moved_.erase(at(variable).id);
}

} // namespace nurbs
} // namespace pcl
