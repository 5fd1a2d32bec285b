// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "clique_tree.h"

namespace pcl {
namespace nurbs {

/** Blocks of the inverse of a factored matrix, for many queries: the inverse is
 * computed within each clique once, from the root down; that of a pair of variables
 * then costs the paths to the first clique that they have in common, and nothing within
 * one clique. For few queries CliqueTree::inverseOf() is cheaper. */
class CliqueInverse {
public:
  /** O(the factorisation).
   * \param[in] tree that was built and factored as a whole; it has to stay as it is */
  explicit CliqueInverse(const CliqueTree& tree);

  /** Covariances between all pairs of some variables, in blocks in the order given. */
  Eigen::MatrixXd
  of(const std::vector<int>& variables) const;

private:
  /** What is known of a clique; rows are its own variables, then its separator. */
  struct Part {
    const Clique* clique = nullptr;
    int depth = 0;
    std::vector<int> starts;    /**< of each of its variables */
    std::vector<int> in_parent; /**< rows of the separator there */
    Eigen::MatrixXd given; /**< own variables = -given * separator + something new */
    Eigen::MatrixXd inverse;
  };

  Part&
  at(const Clique* clique)
  {
    return parts_[static_cast<std::size_t>(clique->place)];
  }

  const Part&
  at(const Clique* clique) const
  {
    return parts_[static_cast<std::size_t>(clique->place)];
  }

  void
  addRows(Part& part) const;

  void
  invert(Part& part) const;

  Eigen::MatrixXd
  between(int a, int b) const;

  /** A variable as a combination of rows of a clique. */
  struct Combination {
    const Part* part = nullptr;
    Eigen::MatrixXd rows;
  };

  const Part&
  partOf(int variable) const;

  /** The first row of a variable, -1 if the clique does not have it. */
  static int
  rowOf(int variable, const Part& part);

  Combination
  combinationFor(int variable) const;

  /** The same of the rows of the clique above. */
  void
  climb(Combination& combination) const;

  const CliqueTree& tree_;
  std::vector<Part> parts_; // by the cliques' places
};

} // namespace nurbs
} // namespace pcl
