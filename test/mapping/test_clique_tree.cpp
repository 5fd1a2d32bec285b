// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The tree against dense algebra: factor, solution, changes, inverse.

#include "clique_inverse.h"
#include "elimination_order.h"
#include "panel_cholesky.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <random>

namespace {

using namespace pcl::nurbs;

TEST(PanelCholesky, IsTheDenseFactor)
{
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  for (int columns = 1; columns <= 19; ++columns)
    for (const int more : {0, 1, 3, 8, 13}) {
      const int size = columns + more;
      const Eigen::MatrixXd any = Eigen::MatrixXd::NullaryExpr(
          size, size, [&](Eigen::Index, Eigen::Index) { return entry(generator); });
      const Eigen::MatrixXd matrix =
          any * any.transpose() + Eigen::MatrixXd::Identity(size, size);
      Eigen::MatrixXd panel = matrix.leftCols(columns);
      Eigen::MatrixXd rest = matrix.bottomRightCorner(more, more);
      ASSERT_TRUE(factorPanel(panel.data(), size, columns, 0.0));
      subtractPanel(panel.data(), size, columns, rest.data(), more);
      const Eigen::MatrixXd lower = matrix.llt().matrixL();
      for (int column = 0; column < columns; ++column)
        EXPECT_LT((panel.col(column) - lower.col(column)).tail(size - column).norm(),
                  1e-12 * size);
      const Eigen::MatrixXd corner = lower.bottomRightCorner(more, more);
      const Eigen::MatrixXd expected = corner * corner.transpose();
      for (int column = 0; column < more; ++column)
        EXPECT_LT((rest.col(column) - expected.col(column)).tail(more - column).norm(),
                  1e-11 * size);
    }
}

TEST(PanelCholesky, RefusesWhatIsNotPositive)
{
  Eigen::Matrix2d matrix;
  matrix << 1.0, 2.0, 2.0, 1.0;
  EXPECT_FALSE(factorPanel(matrix.data(), 2, 2, 0.0));
  matrix << 1.0, 1.0, 1.0, 1.0 + 1e-10;
  EXPECT_FALSE(factorPanel(matrix.data(), 2, 2, 1e-6));
  matrix << std::nan(""), 0.0, 0.0, 1.0;
  EXPECT_FALSE(factorPanel(matrix.data(), 2, 2, 0.0));
}

/** A random problem in a tree and as dense matrices. Variables have 1 to 6 rows. */
class RandomProblem {
public:
  explicit RandomProblem(unsigned seed) : generator_(seed) {}

  void
  addVariable()
  {
    const int size = 1 + static_cast<int>(generator_() % 6);
    starts_.push_back(rows_);
    rows_ += size;
    tree.addVariable(size);
    addTerm(static_cast<int>(starts_.size()) - 1, -1);
  }

  int
  addTerm(int a, int b)
  {
    const int width = tree.dimension(a) + (b < 0 ? 0 : tree.dimension(b));
    std::uniform_real_distribution<double> entry(-1.0, 1.0);
    const auto any = [&](Eigen::Index, Eigen::Index) { return entry(generator_); };
    const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(width, width, any);
    terms_.push_back(
        {a,
         b,
         root.transpose() * root + 0.1 * Eigen::MatrixXd::Identity(width, width),
         Eigen::MatrixXd::NullaryExpr(2, width, any),
         true});
    return tree.addTerm(a, b);
  }

  void
  removeTerm(int term)
  {
    tree.removeTerm(term);
    terms_[static_cast<std::size_t>(term)].present = false;
  }

  /** Change all of a variable's terms. */
  void
  scaleTermsOf(int variable)
  {
    for (Term& term : terms_)
      if (term.a == variable || term.b == variable)
        term.matrix *= 1.5;
  }

  CliqueTree::Assemble
  assemble() const
  {
    return [this](int index, FrontView& front) {
      const Term& term = terms_[static_cast<std::size_t>(index)];
      const int a = tree.dimension(term.a);
      front.add(term.a, term.a, Eigen::MatrixXd(term.matrix.topLeftCorner(a, a)));
      front.addRight(term.a, Eigen::MatrixXd(term.right.leftCols(a)));
      if (term.b < 0)
        return;
      const int b = tree.dimension(term.b);
      front.add(term.b, term.b, Eigen::MatrixXd(term.matrix.bottomRightCorner(b, b)));
      front.add(term.b, term.a, Eigen::MatrixXd(term.matrix.bottomLeftCorner(b, a)));
      front.addRight(term.b, Eigen::MatrixXd(term.right.rightCols(b)));
    };
  }

  Eigen::MatrixXd
  matrix() const
  {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(rows_, rows_);
    for (const Term& term : terms_)
      if (term.present) {
        const std::vector<int> rows = rowsOf(term);
        sum(rows, rows) += term.matrix;
      }
    return sum;
  }

  void
  expectSolution(const char* when) const
  {
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(rows_, 2);
    for (const Term& term : terms_)
      if (term.present)
        right(rowsOf(term), Eigen::all) += term.right.transpose();
    const Eigen::MatrixXd expected = matrix().llt().solve(right);
    for (std::size_t k = 0; k < starts_.size(); ++k) {
      const auto variable = static_cast<int>(k);
      EXPECT_LT((tree.solution(variable) -
                 expected.middleRows(starts_[k], tree.dimension(variable)))
                    .cwiseAbs()
                    .maxCoeff(),
                1e-8)
          << when << ' ' << variable;
    }
  }

  /** Of some variables, against the dense inverse. */
  void
  expectInverse(const Eigen::MatrixXd& part,
                const std::vector<int>& some,
                const char* how) const
  {
    const Eigen::MatrixXd dense = matrix().inverse();
    std::vector<int> rows;
    for (const int variable : some)
      for (int k = 0; k < tree.dimension(variable); ++k)
        rows.push_back(startOf(variable) + k);
    const Eigen::MatrixXd expected = dense(rows, rows);
    ASSERT_EQ(part.rows(), expected.rows());
    EXPECT_LT((part - expected).norm(), 1e-8 * expected.norm()) << how;
  }

  int
  variables() const
  {
    return static_cast<int>(starts_.size());
  }

  int
  startOf(int variable) const
  {
    return starts_[static_cast<std::size_t>(variable)];
  }

  int
  anyVariable()
  {
    return static_cast<int>(generator_() % starts_.size());
  }

  CliqueTree tree{2, true};

private:
  struct Term {
    int a;
    int b;
    Eigen::MatrixXd matrix;
    Eigen::MatrixXd right;
    bool present;
  };

  std::vector<int>
  rowsOf(const Term& term) const
  {
    std::vector<int> rows;
    for (const int variable : {term.a, term.b})
      for (int k = 0; variable >= 0 && k < tree.dimension(variable); ++k)
        rows.push_back(startOf(variable) + k);
    return rows;
  }

  std::mt19937 generator_;
  std::vector<int> starts_;
  int rows_ = 0;
  std::vector<Term> terms_;
};

/** A chain with random chords. */
void
fill(RandomProblem& problem, int variables, int chords, VariablePairs& pairs)
{
  for (int k = 0; k < variables; ++k)
    problem.addVariable();
  for (int k = 1; k < variables + chords; ++k) {
    const int a = k < variables ? k - 1 : problem.anyVariable();
    const int b = k < variables ? k : problem.anyVariable();
    if (a != b) {
      problem.addTerm(a, b);
      pairs.emplace_back(a, b);
    }
  }
}

TEST(CliqueTree, SolvesAndInvertsAsDenseAlgebra)
{
  for (unsigned seed = 1; seed <= 8; ++seed) {
    RandomProblem problem(seed);
    VariablePairs pairs;
    fill(problem, 30, static_cast<int>(5 * seed), pairs);
    problem.tree.build(eliminationOrder(problem.variables(), pairs));
    ASSERT_TRUE(problem.tree.factor(problem.assemble(), 1e-14));
    EXPECT_EQ(problem.tree.solve(-1.0), problem.variables());
    problem.expectSolution("built");
    const Eigen::MatrixXd dense = problem.matrix().inverse();
    const std::vector<int> some{7, 2, 29, 8, 14};
    problem.expectInverse(problem.tree.inverseOf(some), some, "path by path");
    problem.expectInverse(CliqueInverse(problem.tree).of(some), some, "by cliques");
  }
}

TEST(CliqueInverse, OfPartsThatNothingJoins)
{
  RandomProblem problem(9);
  VariablePairs pairs;
  fill(problem, 12, 3, pairs);
  const int alone = problem.variables();
  problem.addVariable();
  problem.tree.build(eliminationOrder(problem.variables(), pairs));
  ASSERT_TRUE(problem.tree.factor(problem.assemble(), 1e-14));
  const std::vector<int> some{3, alone};
  problem.expectInverse(CliqueInverse(problem.tree).of(some), some, "parts");
}

TEST(CliqueTree, UpdatesAreAsGoodAsNew)
{
  for (unsigned seed = 11; seed <= 16; ++seed) {
    RandomProblem problem(seed);
    int eliminated = 0;
    std::vector<int> chords;
    for (int k = 0; k < 60; ++k) {
      problem.addVariable();
      std::vector<int> changed{k};
      if (k > 0) {
        problem.addTerm(k - 1, k);
        changed.push_back(k - 1);
      }
      if (k % 5 == 4) {
        const int other = problem.anyVariable();
        if (other != k) {
          chords.push_back(problem.addTerm(other, k));
          changed.push_back(other);
        }
      }
      std::vector<int> moved;
      if (k % 7 == 6) {
        moved.push_back(problem.anyVariable());
        problem.scaleTermsOf(moved.front());
      }
      ASSERT_TRUE(
          problem.tree.update(changed, moved, problem.assemble(), 1e-14, eliminated));
      EXPECT_GE(eliminated, static_cast<int>(k == 0 ? 1 : 2));
      problem.tree.solve(0.0);
      problem.expectSolution("grown");
    }
    if (!chords.empty()) {
      problem.removeTerm(chords.front());
      std::vector<int> all(static_cast<std::size_t>(problem.variables()));
      for (std::size_t k = 0; k < all.size(); ++k)
        all[k] = static_cast<int>(k);
      ASSERT_TRUE(problem.tree.update(all, {}, problem.assemble(), 1e-14, eliminated));
      EXPECT_EQ(eliminated, problem.variables());
      problem.tree.solve(0.0);
      problem.expectSolution("removed");
    }
  }
}

/** The end of a chain is far from its beginning. */
TEST(CliqueTree, UpdatesAreLocal)
{
  RandomProblem problem(21);
  int eliminated = 0;
  for (int k = 0; k < 200; ++k) {
    problem.addVariable();
    if (k > 0)
      problem.addTerm(k - 1, k);
    ASSERT_TRUE(
        problem.tree.update(k > 0 ? std::vector<int>{k - 1, k} : std::vector<int>{k},
                            {},
                            problem.assemble(),
                            1e-14,
                            eliminated));
    EXPECT_LT(eliminated, 20);
    problem.tree.solve(0.0);
  }
  problem.expectSolution("chain");
}

TEST(CliqueTree, RefusesIndefiniteMatrices)
{
  CliqueTree tree(0, false);
  tree.addVariable(1);
  tree.addVariable(1);
  tree.addTerm(0, 1);
  tree.build({0, 1});
  const auto with = [&](double corner) {
    return tree.factor(
        [&](int, FrontView& front) {
          const Eigen::Matrix<double, 1, 1> one(1.0);
          const Eigen::Matrix<double, 1, 1> last(corner);
          front.add(0, 0, one);
          front.add(1, 0, one);
          front.add(1, 1, last);
        },
        0.0);
  };
  EXPECT_TRUE(with(1.1));
  EXPECT_FALSE(with(0.9));
}

} // namespace
