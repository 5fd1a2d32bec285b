// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

// Changes of a clique tree, and parts of its inverse: what goes along paths to the
// root.

#include "clique_builder.h"
#include "clique_tree.h"
#include "elimination_order.h"

#include <algorithm>
#include <map>
#include <set>

namespace pcl {
namespace nurbs {
namespace {

/** Order of elimination of the variables of cliques that were taken apart: those with
 * new terms last, so that the next ones touch little. */
class LocalOrder {
public:
  LocalOrder(const std::vector<int>& variables, std::vector<int>& places)
      : variables_(variables), places_(places)
  {
    for (std::size_t k = 0; k < variables.size(); ++k)
      places_[static_cast<std::size_t>(variables[k])] = static_cast<int>(k);
  }

  ~LocalOrder()
  {
    for (const int variable : variables_)
      places_[static_cast<std::size_t>(variable)] = -1;
  }

  LocalOrder(const LocalOrder&) = delete;
  LocalOrder&
  operator=(const LocalOrder&) = delete;

  int
  place(int variable) const
  {
    return variable < 0 ? -1 : places_[static_cast<std::size_t>(variable)];
  }

  std::vector<std::vector<int>> rows;

  std::vector<int>
  order(const std::vector<int>& last) const
  {
    std::vector<int> groups(variables_.size(), 0);
    for (const int variable : last)
      if (place(variable) >= 0)
        groups[static_cast<std::size_t>(place(variable))] = 1;
    if (std::all_of(groups.begin(), groups.end(), [](int group) { return group == 1; }))
      std::fill(groups.begin(), groups.end(), 0); // a group must not be empty
    std::vector<int> result = constrainedOrder(rows, groups);
    for (int& k : result)
      k = variables_[static_cast<std::size_t>(k)];
    return result;
  }

private:
  const std::vector<int>& variables_;
  std::vector<int>& places_;
};

} // namespace

void
CliqueTree::mark(Clique* clique, std::vector<Clique*>& marked)
{
  for (; clique != nullptr && !clique->is_marked; clique = clique->parent) {
    clique->is_marked = true;
    marked.push_back(clique);
  }
}

/** A variable stands in its own clique and, below it, in a connected part of the tree.
 */
void
CliqueTree::markAllWith(int variable, std::vector<Clique*>& marked)
{
  std::vector<Clique*> stack{clique_of_[static_cast<std::size_t>(variable)]};
  while (!stack.empty()) {
    Clique* const clique = stack.back();
    stack.pop_back();
    if (clique == nullptr)
      continue;
    mark(clique, marked);
    for (Clique* child : clique->children)
      if (std::find(child->variables.begin() + child->own,
                    child->variables.end(),
                    variable) != child->variables.end())
        stack.push_back(child);
  }
}

bool
CliqueTree::update(const std::vector<int>& changed,
                   const std::vector<int>& moved,
                   const Assemble& assemble,
                   double least,
                   int& eliminated)
{
  std::vector<Clique*> marked;
  std::vector<int> variables;
  for (const int variable : changed) {
    Clique* const clique = clique_of_[static_cast<std::size_t>(variable)];
    if (clique == nullptr && removed_[static_cast<std::size_t>(variable)] == 0)
      variables.push_back(variable);
    mark(clique, marked);
  }
  std::sort(variables.begin(), variables.end());
  variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
  for (const int variable : moved)
    markAllWith(variable, marked);
  std::vector<Clique*> orphans;
  for (Clique* clique : marked) {
    for (int k = 0; k < clique->own; ++k) {
      const int variable = clique->variables[static_cast<std::size_t>(k)];
      clique_of_[static_cast<std::size_t>(variable)] = nullptr;
      if (removed_[static_cast<std::size_t>(variable)] == 0)
        variables.push_back(variable);
    }
    for (Clique* child : clique->children)
      if (!child->is_marked)
        orphans.push_back(child);
  }
  for (Clique* clique : marked)
    dropClique(*clique);
  eliminated = static_cast<int>(variables.size());
  CliqueBuilder(*this, orderOf(variables, orphans, changed), orphans).run();
  return factor(assemble, least);
}

std::vector<int>
CliqueTree::orderOf(const std::vector<int>& variables,
                    const std::vector<Clique*>& orphans,
                    const std::vector<int>& last)
{
  LocalOrder local(variables, positions_);
  for (const int variable : variables)
    for (const int term : terms_of_[static_cast<std::size_t>(variable)]) {
      const auto [a, b] = terms_[static_cast<std::size_t>(term)];
      const int other = local.place(a == variable ? b : a);
      if (other > local.place(variable))
        local.rows.push_back({local.place(variable), other});
      else if (b < 0)
        local.rows.push_back({local.place(variable)});
    }
  for (const Clique* orphan : orphans) {
    local.rows.emplace_back();
    for (auto k = static_cast<std::size_t>(orphan->own); k < orphan->variables.size();
         ++k)
      local.rows.back().push_back(local.place(orphan->variables[k]));
  }
  return local.order(last);
}

Eigen::MatrixXd
CliqueTree::inverseOf(const std::vector<int>& variables) const
{
  // Solve L w = e along the paths to the roots; the inverse is then w^T w.
  std::map<int, Eigen::MatrixXd> right; // by variable
  Eigen::Index columns = 0;
  for (const int variable : variables)
    columns += dimension(variable);
  std::set<std::pair<int, const Clique*>> path; // deepest first
  const auto depthOf = [](const Clique* clique) {
    int depth = 0;
    for (; clique->parent != nullptr; clique = clique->parent)
      ++depth;
    return depth;
  };
  Eigen::Index column = 0;
  for (const int variable : variables) {
    const int size = dimension(variable);
    Eigen::MatrixXd& own =
        right.try_emplace(variable, Eigen::MatrixXd::Zero(size, columns)).first->second;
    own.middleCols(column, size).setIdentity();
    column += size;
    const Clique* clique = clique_of_[static_cast<std::size_t>(variable)];
    for (int depth = depthOf(clique); clique != nullptr; clique = clique->parent)
      path.emplace(-depth--, clique);
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(columns, columns);
  for (const auto& [depth, clique] : path)
    addToInverse(*clique, right, result);
  return result;
}

void
CliqueTree::addToInverse(const Clique& clique,
                         std::map<int, Eigen::MatrixXd>& right,
                         Eigen::MatrixXd& inverse) const
{
  const Eigen::Index size = clique.own_size + clique.separator_size;
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(size, inverse.cols());
  Eigen::Index offset = 0;
  for (const int variable : clique.variables) {
    const auto known = right.find(variable);
    if (known != right.end() && offset < clique.own_size)
      values.middleRows(offset, dimension(variable)) = known->second;
    offset += dimension(variable);
  }
  const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> panel(
      clique.panel.data(),
      size,
      clique.own_size,
      Eigen::OuterStride<>(size + right_sides_));
  auto own = values.topRows(clique.own_size);
  panel.topRows(clique.own_size).triangularView<Eigen::Lower>().solveInPlace(own);
  inverse.noalias() += own.transpose() * own;
  const Eigen::MatrixXd below = panel.bottomRows(clique.separator_size) * own;
  offset = 0;
  for (auto k = static_cast<std::size_t>(clique.own); k < clique.variables.size();
       ++k) {
    const int variable = clique.variables[k];
    const int rows = dimension(variable);
    Eigen::MatrixXd& sum =
        right.try_emplace(variable, Eigen::MatrixXd::Zero(rows, inverse.cols()))
            .first->second;
    sum -= below.middleRows(offset, rows);
    offset += rows;
  }
}

} // namespace nurbs
} // namespace pcl
