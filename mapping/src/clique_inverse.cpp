// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "clique_inverse.h"

#include <algorithm>

namespace pcl {
namespace nurbs {

CliqueInverse::CliqueInverse(const CliqueTree& tree)
    : tree_(tree), parts_(tree.cliqueCount())
{
  for (const Clique* clique : tree.built_) { // parents first
    Part& part = at(clique);
    part.clique = clique;
    part.depth = clique->parent == nullptr ? 0 : at(clique->parent).depth + 1;
    addRows(part);
    invert(part);
  }
}

void
CliqueInverse::addRows(Part& part) const
{
  int row = 0;
  for (const int variable : part.clique->variables) {
    part.starts.push_back(row);
    row += tree_.dimension(variable);
  }
  const Clique* parent = part.clique->parent;
  if (parent == nullptr)
    return;
  std::vector<std::pair<int, int>> places; // variables of the parent and their rows
  for (std::size_t k = 0; k < parent->variables.size(); ++k)
    places.emplace_back(parent->variables[k], at(parent).starts[k]);
  std::sort(places.begin(), places.end());
  for (auto k = static_cast<std::size_t>(part.clique->own);
       k < part.clique->variables.size();
       ++k) {
    const int variable = part.clique->variables[k];
    const auto place =
        std::lower_bound(places.begin(), places.end(), std::make_pair(variable, 0));
    for (int r = 0; r < tree_.dimension(variable); ++r)
      part.in_parent.push_back(place->second + r);
  }
}

void
CliqueInverse::invert(Part& part) const
{
  const Eigen::Index own = part.clique->own_size;
  const Eigen::Index separator = part.clique->separator_size;
  const Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> panel(
      part.clique->panel.data(),
      own + separator,
      own,
      Eigen::OuterStride<>(own + separator + tree_.right_sides_));
  const auto factor = panel.topRows(own).triangularView<Eigen::Lower>();
  const Eigen::MatrixXd root =
      factor.solve(Eigen::MatrixXd::Identity(own, own)); // of the inverse
  part.inverse.resize(own + separator, own + separator);
  auto corner = part.inverse.topLeftCorner(own, own);
  corner.noalias() = root.transpose() * root;
  if (separator == 0)
    return;
  part.given = factor.transpose().solve(panel.bottomRows(separator).transpose());
  auto cross = part.inverse.topRightCorner(own, separator);
  part.inverse.bottomRightCorner(separator, separator) =
      at(part.clique->parent).inverse(part.in_parent, part.in_parent);
  cross.noalias() = -part.given * part.inverse.bottomRightCorner(separator, separator);
  corner.noalias() -= cross * part.given.transpose();
  part.inverse.bottomLeftCorner(separator, own) = cross.transpose();
}

const CliqueInverse::Part&
CliqueInverse::partOf(int variable) const
{
  return at(tree_.clique_of_[static_cast<std::size_t>(variable)]);
}

int
CliqueInverse::rowOf(int variable, const Part& part)
{
  const std::vector<int>& variables = part.clique->variables;
  const auto place = std::find(variables.begin(), variables.end(), variable);
  return place == variables.end()
             ? -1
             : part.starts[static_cast<std::size_t>(place - variables.begin())];
}

CliqueInverse::Combination
CliqueInverse::combinationFor(int variable) const
{
  const Part& part = partOf(variable);
  const int size = tree_.dimension(variable);
  Combination result{&part, Eigen::MatrixXd::Zero(part.inverse.rows(), size)};
  result.rows.middleRows(rowOf(variable, part), size).setIdentity();
  return result;
}

void
CliqueInverse::climb(Combination& combination) const
{
  const Part& part = *combination.part;
  const Part& parent = at(part.clique->parent);
  const Eigen::Index own = part.clique->own_size;
  const Eigen::Index separator = part.clique->separator_size;
  Eigen::MatrixXd rows =
      Eigen::MatrixXd::Zero(parent.inverse.rows(), combination.rows.cols());
  // Few columns: inner products are faster than a product in blocks.
  rows(part.in_parent, Eigen::all) =
      combination.rows.bottomRows(separator) -
      part.given.transpose().lazyProduct(combination.rows.topRows(own));
  combination = {&parent, std::move(rows)};
}

Eigen::MatrixXd
CliqueInverse::between(int a, int b) const
{
  for (const int either : {a, b}) {
    const Part& part = partOf(either);
    const int row = rowOf(a, part);
    const int column = rowOf(b, part);
    if (row >= 0 && column >= 0)
      return part.inverse.block(row, column, tree_.dimension(a), tree_.dimension(b));
  }
  Combination first = combinationFor(a);
  Combination second = combinationFor(b);
  while (first.part != second.part) {
    Combination& lower = first.part->depth >= second.part->depth ? first : second;
    if (lower.part->depth == 0)
      return Eigen::MatrixXd::Zero(first.rows.cols(), second.rows.cols());
    climb(lower);
  }
  // Symmetric, and again few columns.
  const Eigen::MatrixXd carried =
      first.part->inverse.transpose().lazyProduct(second.rows);
  return first.rows.transpose().lazyProduct(carried);
}

Eigen::MatrixXd
CliqueInverse::of(const std::vector<int>& variables) const
{
  std::vector<Eigen::Index> starts = {0};
  for (const int variable : variables)
    starts.push_back(starts.back() + tree_.dimension(variable));
  Eigen::MatrixXd result(starts.back(), starts.back());
  for (std::size_t i = 0; i < variables.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const Eigen::MatrixXd block = between(variables[i], variables[j]);
      result.block(starts[i], starts[j], block.rows(), block.cols()) = block;
      result.block(starts[j], starts[i], block.cols(), block.rows()) =
          block.transpose();
    }
  return result;
}

} // namespace nurbs
} // namespace pcl
