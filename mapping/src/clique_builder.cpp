// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "clique_builder.h"

#include <algorithm>
#include <utility>

namespace pcl {
namespace nurbs {

CliqueBuilder::CliqueBuilder(CliqueTree& tree,
                             const std::vector<int>& order,
                             const std::vector<Clique*>& orphans)
    : tree_(tree),
      order_(order),
      orphans_(orphans),
      positions_(tree.positions_),
      structures_(order.size()),
      terms_(order.size()),
      orphans_at_(order.size()),
      children_(order.size()),
      clique_at_(order.size(), nullptr)
{
  for (std::size_t k = 0; k < order.size(); ++k)
    positions_[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
}

CliqueBuilder::~CliqueBuilder()
{
  for (const int variable : order_)
    positions_[static_cast<std::size_t>(variable)] = -1;
}

void
CliqueBuilder::run()
{
  placeTerms();
  placeOrphans();
  findStructures();
  makeCliques();
}

/** A term belongs where its first variable is eliminated; if the other one stays in an
 * orphan, the orphan has it already. */
void
CliqueBuilder::placeTerms()
{
  for (std::size_t k = 0; k < order_.size(); ++k)
    for (const int term : tree_.terms_of_[static_cast<std::size_t>(order_[k])]) {
      const auto [a, b] = tree_.terms_[static_cast<std::size_t>(term)];
      const int other = a == order_[k] ? b : a;
      const int place = other < 0 ? -1 : positions_[static_cast<std::size_t>(other)];
      if (other >= 0 && place < static_cast<int>(k))
        continue;
      terms_[k].push_back(term);
      if (other >= 0)
        structures_[k].push_back(place);
    }
}

void
CliqueBuilder::placeOrphans()
{
  for (Clique* orphan : orphans_) {
    std::vector<int> places;
    for (auto k = static_cast<std::size_t>(orphan->own); k < orphan->variables.size();
         ++k)
      places.push_back(positions_[static_cast<std::size_t>(orphan->variables[k])]);
    std::sort(places.begin(), places.end());
    const auto first = static_cast<std::size_t>(places.front());
    orphans_at_[first].push_back(orphan);
    structures_[first].insert(
        structures_[first].end(), places.begin() + 1, places.end());
  }
}

void
CliqueBuilder::findStructures()
{
  std::vector<int> seen(order_.size(), -1);
  for (std::size_t k = 0; k < order_.size(); ++k) {
    std::vector<int> all;
    const auto own = static_cast<int>(k);
    const auto take = [&](const std::vector<int>& places) {
      for (const int place : places)
        if (place != own &&
            std::exchange(seen[static_cast<std::size_t>(place)], own) != own)
          all.push_back(place);
    };
    take(structures_[k]);
    for (const int child : children_[k])
      take(structures_[static_cast<std::size_t>(child)]);
    std::sort(all.begin(), all.end());
    if (!all.empty())
      children_[static_cast<std::size_t>(all.front())].push_back(own);
    structures_[k] = std::move(all);
  }
}

/** The clique of the parent if the variable fits in it without many zeros, or a new
 * one below it. */
Clique&
CliqueBuilder::cliqueFor(std::size_t position)
{
  const std::vector<int>& structure = structures_[position];
  Clique* const parent = structure.empty()
                             ? nullptr
                             : clique_at_[static_cast<std::size_t>(structure.front())];
  if (parent != nullptr) {
    const auto all = static_cast<double>(parent->variables.size());
    const double own = parent->own + 1;
    const double zeros = parent->zeros + all - static_cast<double>(structure.size());
    const double pairs = own * (own + 1.0) / 2.0 + own * (all + 1.0 - own);
    const double share = own <= 4 ? 0.3 : own <= 12 ? 0.1 : 0.05;
    if (zeros <= share * pairs) {
      parent->zeros = zeros;
      return *parent;
    }
  }
  Clique& clique = tree_.newClique();
  clique.parent = parent;
  if (parent != nullptr)
    parent->children.push_back(&clique);
  for (const int place : structure)
    clique.variables.push_back(order_[static_cast<std::size_t>(place)]);
  tree_.built_.push_back(&clique);
  return clique;
}

void
CliqueBuilder::makeCliques()
{
  tree_.built_.clear();
  for (std::size_t k = order_.size(); k-- > 0;) {
    Clique& clique = cliqueFor(k);
    clique_at_[k] = &clique;
    clique.variables.push_back(order_[k]); // sorted when all are there
    ++clique.own;
    clique.terms.insert(clique.terms.end(), terms_[k].begin(), terms_[k].end());
    for (Clique* orphan : orphans_at_[k]) {
      orphan->parent = &clique;
      clique.children.push_back(orphan);
    }
  }
  for (Clique* clique : tree_.built_)
    finish(*clique);
}

/** Own variables to the front, in the order of elimination, which puts them before
 * those of the separator. */
void
CliqueBuilder::finish(Clique& clique)
{
  std::sort(clique.variables.begin(), clique.variables.end(), [this](int a, int b) {
    return positions_[static_cast<std::size_t>(a)] <
           positions_[static_cast<std::size_t>(b)];
  });
  const auto count = static_cast<int>(clique.variables.size());
  for (int k = 0; k < count; ++k) {
    const int variable = clique.variables[static_cast<std::size_t>(k)];
    if (k < clique.own) {
      tree_.clique_of_[static_cast<std::size_t>(variable)] = &clique;
      clique.own_size += tree_.dimension(variable);
    }
    else
      clique.separator_size += tree_.dimension(variable);
  }
}

} // namespace nurbs
} // namespace pcl
