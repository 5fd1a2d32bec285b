// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "group_testing.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** Sums over rectangles in constant time. */
class SummedScores {
public:
  explicit SummedScores(const Eigen::MatrixXd& scores)
      : count_(table(scores.array().isNaN().select(
            0.0, Eigen::ArrayXXd::Ones(scores.rows(), scores.cols())))),
        sum_(table(scores.array().isNaN().select(0.0, scores.array()))),
        energy_(table(scores.array().isNaN().select(0.0, scores.array().square()))),
        scores_(scores)
  {
  }

  /** Largest excess of the three statistics, in standard deviations; negative if there
   * is no sample. */
  double
  test(BinGroup& group) const
  {
    const double count = over(count_, group);
    if (count == 0.0)
      return -1.0;
    group.energy = over(energy_, group);
    const double energy = (group.energy - count) / std::sqrt(2.0 * count);
    const double mean = std::abs(over(sum_, group)) / std::sqrt(count);
    const auto block =
        scores_.block(group.row, group.column, group.rows, group.columns).array();
    const double largest =
        std::sqrt(block.isNaN().select(0.0, block.square()).maxCoeff()) -
        std::sqrt(2.0 * std::log(count));
    group.significance = std::max({energy, mean, largest});
    return group.significance;
  }

private:
  static Eigen::MatrixXd
  table(const Eigen::ArrayXXd& values)
  {
    Eigen::MatrixXd result =
        Eigen::MatrixXd::Zero(values.rows() + 1, values.cols() + 1);
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      for (Eigen::Index i = 0; i < values.rows(); ++i)
        result(i + 1, j + 1) =
            values(i, j) + result(i, j + 1) + result(i + 1, j) - result(i, j);
    return result;
  }

  static double
  over(const Eigen::MatrixXd& sums, const BinGroup& g)
  {
    return sums(g.row + g.rows, g.column + g.columns) -
           sums(g.row, g.column + g.columns) - sums(g.row + g.rows, g.column) +
           sums(g.row, g.column);
  }

  Eigen::MatrixXd count_, sum_, energy_;
  const Eigen::MatrixXd& scores_;
};

std::pair<BinGroup, BinGroup>
halves(const BinGroup& group)
{
  BinGroup first = group;
  BinGroup second = group;
  if (group.rows >= group.columns) {
    first.rows = group.rows / 2;
    second.row += first.rows;
    second.rows -= first.rows;
  }
  else {
    first.columns = group.columns / 2;
    second.column += first.columns;
    second.columns -= first.columns;
  }
  return {first, second};
}

} // namespace

std::vector<BinGroup>
findSalientGroups(const Eigen::MatrixXd& scores, double significance)
{
  const SummedScores sums(scores);
  BinGroup whole;
  whole.rows = static_cast<int>(scores.rows());
  whole.columns = static_cast<int>(scores.cols());
  std::vector<BinGroup> pending;
  if (sums.test(whole) > significance)
    pending.push_back(whole);
  std::vector<BinGroup> salient;
  while (!pending.empty()) {
    const BinGroup group = pending.back();
    pending.pop_back();
    bool split = false;
    if (group.rows * group.columns > 1) {
      auto [first, second] = halves(group);
      for (BinGroup* half : {&first, &second})
        if (sums.test(*half) > significance) {
          pending.push_back(*half);
          split = true;
        }
    }
    if (!split)
      salient.push_back(group);
  }
  return salient;
}

} // namespace nurbs
} // namespace pcl
