// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "clique_tree.h"

namespace pcl {
namespace nurbs {

/** Makes cliques of variables in an order of elimination and joins them to those that
 * stay (orphans) below them. */
class CliqueBuilder {
public:
  /** \param[in] order all variables of the new cliques \param[in] orphans cliques whose
   * separators are among them */
  CliqueBuilder(CliqueTree& tree,
                const std::vector<int>& order,
                const std::vector<Clique*>& orphans);

  ~CliqueBuilder();

  CliqueBuilder(const CliqueBuilder&) = delete;
  CliqueBuilder&
  operator=(const CliqueBuilder&) = delete;

  /** Add the cliques to the tree and list them as built. */
  void
  run();

private:
  void
  placeTerms();

  void
  placeOrphans();

  void
  findStructures();

  void
  makeCliques();

  Clique&
  cliqueFor(std::size_t position);

  void
  finish(Clique& clique);

  CliqueTree& tree_;
  const std::vector<int>& order_;
  const std::vector<Clique*>& orphans_;
  std::vector<int>& positions_; // by variable, -1 for others
  // By position: positions that stand in the row of the factor, terms and orphans that
  // begin there, positions whose rows begin there.
  std::vector<std::vector<int>> structures_;
  std::vector<std::vector<int>> terms_;
  std::vector<std::vector<Clique*>> orphans_at_;
  std::vector<std::vector<int>> children_;
  std::vector<Clique*> clique_at_;
};

} // namespace nurbs
} // namespace pcl
