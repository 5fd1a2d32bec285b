// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace pcl {
namespace nurbs {

/** A node of the tree: variables that are eliminated together, given those of its
 * separator, which stand in the nodes above it. */
struct Clique {
  std::vector<int> variables; /**< own ones first, then the separator */
  int own = 0;                /**< how many are own */
  std::vector<int> terms;     /**< assembled here */
  Clique* parent = nullptr;
  std::vector<Clique*> children;
  int own_size = 0;       /**< columns of its own variables */
  int separator_size = 0; /**< columns of its separator */
  /** (own + separator + right sides) x own: Cholesky factor and what is below it. */
  std::vector<double> panel;
  /** (separator + right sides) x separator: what it leaves to its parent. */
  std::vector<double> rest;
  int place = -1;         /**< among the tree's cliques */
  double zeros = 0.0;     /**< pairs of variables that need not be in it */
  bool is_new = false;    /**< factored since it was solved for */
  bool is_marked = false; /**< to be taken apart */
};

/** Where a term adds its part of the normal equations. */
class FrontView {
public:
  FrontView(Clique& clique, const std::vector<int>& offsets, int right_sides)
      : clique_(clique), offsets_(offsets), right_sides_(right_sides)
  {
  }

  /** Add a block of the symmetric matrix, to be called for each pair once.
   * \param[in] block rows of variable a, columns of b; the lower half if a = b */
  template <typename Block>
  void
  add(int a, int b, const Block& block)
  {
    const int row = offsets_[static_cast<std::size_t>(a)];
    const int column = offsets_[static_cast<std::size_t>(b)];
    if (row >= column)
      addAt(row, column, block);
    else
      addAt(column, row, block.transpose());
  }

  /** Add to the right sides. \param[in] values right sides x dimension */
  template <typename Values>
  void
  addRight(int variable, const Values& values)
  {
    addAt(clique_.own_size + clique_.separator_size,
          offsets_[static_cast<std::size_t>(variable)],
          values);
  }

private:
  template <typename Block>
  void
  addAt(int row, int column, const Block& block)
  {
    const int own = clique_.own_size;
    if (column < own)
      addTo(clique_.panel, row, column, own + clique_.separator_size, block);
    else
      addTo(clique_.rest, row - own, column - own, clique_.separator_size, block);
  }

  template <typename Block>
  void
  addTo(std::vector<double>& values, int row, int column, int size, const Block& block)
  {
    using Column = Eigen::Matrix<double, Block::RowsAtCompileTime, 1>;
    const std::ptrdiff_t rows = size + right_sides_;
    for (Eigen::Index k = 0; k < block.cols(); ++k)
      Eigen::Map<Column>(values.data() + row + (column + k) * rows, block.rows()) +=
          block.col(k);
  }

  Clique& clique_;
  const std::vector<int>& offsets_;
  int right_sides_;
};

/** Normal equations of a sparse least-squares problem by multifrontal Cholesky, kept as
 * a tree of cliques, so that a change costs only the part of the tree above it (Kaess,
 * Johannsson, Roberts, Ila, Leonard, Dellaert, iSAM2, IJRR 31(2), 2012: the Bayes
 * tree).
 *
 * Variables and terms are named by 0, 1, 2, ... in the order they were added. A term is
 * about one variable or two. The solution minimises x^T H x / 2 - b^T x for each right
 * side b. */
class CliqueTree {
public:
  /** Adds what a term says to the front. */
  using Assemble = std::function<void(int term, FrontView& front)>;

  /** \param[in] right_sides how many \param[in] keep_rests what cliques leave to their
   * parents is kept, for update() */
  CliqueTree(int right_sides, bool keep_rests);

  CliqueTree(const CliqueTree&) = delete;
  CliqueTree&
  operator=(const CliqueTree&) = delete;

  int
  addVariable(int dimension);

  /** \param[in] b -1 for a term about one variable */
  int
  addTerm(int a, int b);

  /** Take a variable out that no term is about; it is gone with the next update(),
   * which must be told that it has changed. */
  void
  removeVariable(int variable);

  /** The term is gone with the next update(). */
  void
  removeTerm(int term);

  /** Build the tree of all variables anew. \param[in] order of elimination */
  void
  build(const std::vector<int>& order);

  /** Numbers of all cliques. \param[in] least see factorPanel()
   * \return false if the matrix is not positive definite */
  bool
  factor(const Assemble& assemble, double least);

  /** Order, build and factor anew what terms that were added or removed since, or that
   * have changed, touch.
   * \param[in] changed variables with terms that were added or removed
   * \param[in] moved variables all of whose terms have changed
   * \param[out] eliminated number of variables that were eliminated anew
   * \return false if the matrix is not positive definite: build() is then due */
  bool
  update(const std::vector<int>& changed,
         const std::vector<int>& moved,
         const Assemble& assemble,
         double least,
         int& eliminated);

  /** Solve for all variables whose value changes by more than a threshold.
   * \return how many were solved for */
  int
  solve(double threshold);

  /** Variables whose solution the last solve() has changed. */
  const std::vector<int>&
  movedVariables() const
  {
    return moved_list_;
  }

  /** Solution of a variable, dimension x right sides, valid until the next change. */
  Eigen::Map<const Eigen::MatrixXd>
  solution(int variable) const;

  /** Columns of the inverse: covariances between all pairs of some variables, in blocks
   * in the order given. O(path to the root) each. (CliqueInverse: for many queries.) */
  Eigen::MatrixXd
  inverseOf(const std::vector<int>& variables) const;

  /** Set a variable's solution to zero, where it has been moved. */
  void
  clearSolution(int variable);

  int
  dimension(int variable) const
  {
    return dimensions_[static_cast<std::size_t>(variable)];
  }

  std::size_t
  cliqueCount() const
  {
    return cliques_.size();
  }

  /** Entries of the factor. */
  std::size_t
  factorSize() const;

private:
  friend class CliqueBuilder;
  friend class CliqueInverse;

  std::vector<int>
  orderOf(const std::vector<int>& variables,
          const std::vector<Clique*>& orphans,
          const std::vector<int>& last);

  void
  addToInverse(const Clique& clique,
               std::map<int, Eigen::MatrixXd>& right,
               Eigen::MatrixXd& inverse) const;

  static void
  mark(Clique* clique, std::vector<Clique*>& marked);

  void
  markAllWith(int variable, std::vector<Clique*>& marked);

  Clique&
  newClique();

  void
  dropClique(Clique& clique);

  bool
  factorClique(Clique& clique, const Assemble& assemble, double least);

  void
  setOffsets(const Clique& clique);

  void
  addChild(Clique& clique, const Clique& child);

  void
  solveClique(const Clique& clique, double threshold);

  void
  setSolution(int variable,
              const Eigen::Ref<const Eigen::MatrixXd>& values,
              double threshold);

  static void
  releaseRest(Clique& clique);

  int right_sides_;
  bool keep_rests_;
  std::vector<int> dimensions_;
  std::vector<char> removed_;              // by variable
  std::vector<Clique*> clique_of_;         // by variable
  std::vector<std::vector<int>> terms_of_; // by variable
  std::vector<std::pair<int, int>> terms_;
  std::vector<std::unique_ptr<Clique>> cliques_;
  std::vector<int> positions_;   // in the order at hand, -1 for others
  std::vector<int> offsets_;     // of variables in the front at hand
  std::vector<double> solution_; // by variable, kMostFreedom x right sides each
  std::vector<char> moved_;      // by variable: the last solution has changed it
  std::vector<int> moved_list_;
  std::vector<Clique*> built_; // by the last build or update, parents first
};

} // namespace nurbs
} // namespace pcl
