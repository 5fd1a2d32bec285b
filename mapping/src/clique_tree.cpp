// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "clique_tree.h"

#include "clique_builder.h"
#include "panel_cholesky.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kMostFreedom = 6;

std::ptrdiff_t
rowsOf(const Clique& clique, int right_sides)
{
  return clique.own_size + clique.separator_size + right_sides;
}

} // namespace

CliqueTree::CliqueTree(int right_sides, bool keep_rests)
    : right_sides_(right_sides), keep_rests_(keep_rests)
{
}

int
CliqueTree::addVariable(int dimension)
{
  dimensions_.push_back(dimension);
  removed_.push_back(0);
  clique_of_.push_back(nullptr);
  terms_of_.emplace_back();
  offsets_.push_back(-1);
  positions_.push_back(-1);
  moved_.push_back(0);
  solution_.resize(solution_.size() +
                   kMostFreedom * static_cast<std::size_t>(right_sides_));
  return static_cast<int>(dimensions_.size()) - 1;
}

int
CliqueTree::addTerm(int a, int b)
{
  const auto term = static_cast<int>(terms_.size());
  terms_.emplace_back(a, b);
  terms_of_[static_cast<std::size_t>(a)].push_back(term);
  if (b >= 0)
    terms_of_[static_cast<std::size_t>(b)].push_back(term);
  return term;
}

void
CliqueTree::removeVariable(int variable)
{
  removed_[static_cast<std::size_t>(variable)] = 1;
}

void
CliqueTree::removeTerm(int term)
{
  const auto [a, b] = terms_[static_cast<std::size_t>(term)];
  for (const int variable : {a, b})
    if (variable >= 0) {
      std::vector<int>& list = terms_of_[static_cast<std::size_t>(variable)];
      list.erase(std::find(list.begin(), list.end(), term));
    }
}

Clique&
CliqueTree::newClique()
{
  cliques_.push_back(std::make_unique<Clique>());
  cliques_.back()->place = static_cast<int>(cliques_.size()) - 1;
  return *cliques_.back();
}

void
CliqueTree::dropClique(Clique& clique)
{
  const auto place = static_cast<std::size_t>(clique.place);
  std::swap(cliques_[place], cliques_.back());
  cliques_[place]->place = clique.place;
  cliques_.pop_back();
}

void
CliqueTree::build(const std::vector<int>& order)
{
  cliques_.clear();
  std::fill(clique_of_.begin(), clique_of_.end(), nullptr);
  CliqueBuilder(*this, order, {}).run();
}

void
CliqueTree::setOffsets(const Clique& clique)
{
  int offset = 0;
  for (const int variable : clique.variables) {
    offsets_[static_cast<std::size_t>(variable)] = offset;
    offset += dimension(variable);
  }
}

/** Add what a child leaves, block by block, as its variables may stand in another
 * order. */
void
CliqueTree::addChild(Clique& clique, const Clique& child)
{
  FrontView front(clique, offsets_, right_sides_);
  const std::ptrdiff_t stride = rowsOf(child, right_sides_) - child.own_size;
  using Block = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  const auto count = static_cast<int>(child.variables.size());
  int column = 0;
  for (int b = child.own; b < count; ++b) {
    const int variable = child.variables[static_cast<std::size_t>(b)];
    const int width = dimension(variable);
    const double* const values = child.rest.data() + column * stride;
    int row = column;
    for (int a = b; a < count; ++a) {
      const int other = child.variables[static_cast<std::size_t>(a)];
      front.add(
          other,
          variable,
          Block(values + row, dimension(other), width, Eigen::OuterStride<>(stride)));
      row += dimension(other);
    }
    front.addRight(
        variable,
        Block(values + row, right_sides_, width, Eigen::OuterStride<>(stride)));
    column += width;
  }
}

void
CliqueTree::releaseRest(Clique& clique)
{
  std::vector<double>().swap(clique.rest);
}

bool
CliqueTree::factorClique(Clique& clique, const Assemble& assemble, double least)
{
  const std::ptrdiff_t rows = rowsOf(clique, right_sides_);
  clique.panel.assign(static_cast<std::size_t>(rows * clique.own_size), 0.0);
  clique.rest.assign(
      static_cast<std::size_t>((rows - clique.own_size) * clique.separator_size), 0.0);
  setOffsets(clique);
  FrontView front(clique, offsets_, right_sides_);
  for (const int term : clique.terms)
    assemble(term, front);
  for (Clique* child : clique.children) {
    addChild(clique, *child);
    if (!keep_rests_)
      releaseRest(*child);
  }
  if (!factorPanel(clique.panel.data(), static_cast<int>(rows), clique.own_size, least))
    return false;
  subtractPanel(clique.panel.data(),
                static_cast<int>(rows),
                clique.own_size,
                clique.rest.data(),
                clique.separator_size);
  return true;
}

bool
CliqueTree::factor(const Assemble& assemble, double least)
{
  for (auto clique = built_.rbegin(); clique != built_.rend(); ++clique)
    if (!factorClique(**clique, assemble, least))
      return false;
  for (Clique* clique : built_)
    clique->is_new = true;
  return true;
}

Eigen::Map<const Eigen::MatrixXd>
CliqueTree::solution(int variable) const
{
  const std::size_t begin = static_cast<std::size_t>(variable) * kMostFreedom *
                            static_cast<std::size_t>(right_sides_);
  return {solution_.data() + begin, dimension(variable), right_sides_};
}

void
CliqueTree::clearSolution(int variable)
{
  const std::size_t size = kMostFreedom * static_cast<std::size_t>(right_sides_);
  std::fill_n(solution_.begin() + static_cast<std::ptrdiff_t>(
                                      static_cast<std::size_t>(variable) * size),
              size,
              0.0);
}

void
CliqueTree::solveClique(const Clique& clique, double threshold)
{
  using Column = Eigen::Map<const Eigen::VectorXd>;
  const std::ptrdiff_t rows = rowsOf(clique, right_sides_);
  const int size = clique.own_size + clique.separator_size;
  Eigen::MatrixXd values(size, right_sides_);
  int offset = clique.own_size;
  const auto count = clique.variables.size();
  for (auto k = static_cast<std::size_t>(clique.own); k < count; ++k) {
    const int variable = clique.variables[k];
    values.middleRows(offset, dimension(variable)) = solution(variable);
    offset += dimension(variable);
  }
  for (int k = clique.own_size - 1; k >= 0; --k) {
    const double* const column = clique.panel.data() + k * rows;
    const Column below(column + k + 1, size - k - 1);
    for (int c = 0; c < right_sides_; ++c)
      values(k, c) =
          (column[size + c] - below.dot(values.col(c).tail(size - k - 1))) / column[k];
  }
  offset = 0;
  for (int k = 0; k < clique.own; ++k) {
    const int variable = clique.variables[static_cast<std::size_t>(k)];
    setSolution(variable, values.middleRows(offset, dimension(variable)), threshold);
    offset += dimension(variable);
  }
}

void
CliqueTree::setSolution(int variable,
                        const Eigen::Ref<const Eigen::MatrixXd>& values,
                        double threshold)
{
  Eigen::Map<Eigen::MatrixXd> stored(const_cast<double*>(solution(variable).data()),
                                     dimension(variable),
                                     right_sides_);
  if ((values - stored).cwiseAbs().maxCoeff() <= threshold)
    return; // small steps add up in the next one: what is stored stays what others saw
  stored = values;
  moved_[static_cast<std::size_t>(variable)] = 1;
  moved_list_.push_back(variable);
}

int
CliqueTree::solve(double threshold)
{
  for (const int variable : moved_list_)
    moved_[static_cast<std::size_t>(variable)] = 0;
  moved_list_.clear();
  std::vector<Clique*> stack;
  for (Clique* clique : built_)
    if (clique->parent == nullptr)
      stack.push_back(clique);
  int solved = 0;
  while (!stack.empty()) {
    Clique& clique = *stack.back();
    stack.pop_back();
    const bool due =
        clique.is_new ||
        std::any_of(clique.variables.begin() + clique.own,
                    clique.variables.end(),
                    [&](int variable) {
                      return moved_[static_cast<std::size_t>(variable)] != 0;
                    });
    if (!due)
      continue;
    solveClique(clique, threshold);
    clique.is_new = false;
    solved += clique.own;
    stack.insert(stack.end(), clique.children.begin(), clique.children.end());
  }
  return solved;
}

std::size_t
CliqueTree::factorSize() const
{
  std::size_t sum = 0;
  for (const auto& clique : cliques_)
    sum += clique->panel.size();
  return sum;
}

} // namespace nurbs
} // namespace pcl
