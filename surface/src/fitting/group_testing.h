// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A rectangle of bins: rows [row, row + rows), columns [column, column +
 * columns).
 */
struct BinGroup {
  int row = 0;
  int column = 0;
  int rows = 0;
  int columns = 0;
  double energy = 0.0;       /**< sum of squared scores */
  double significance = 0.0; /**< how far the test statistic exceeds its expectation */
};

/** \brief Find the bins whose scores are not noise by adaptive group testing.
 *
 * All bins together are one group. A group is tested as a whole; a positive one is
 * split in two across its longer side and both halves are tested, until a positive
 * group cannot be split or none of its halves is positive. With few defects among m
 * bins this takes O(d log m) tests (generalised binary splitting, Hwang 1972; Du &
 * Hwang, Combinatorial Group Testing, chapter 2). A test looks for three signs in
 * scores that would be N(0, 1) for noise: too much energy (chi-squared with as many
 * degrees of freedom as bins), a mean that is not zero, and one score that is too large
 * for the best of so many.
 *
 * \param[in] scores one per bin, NaN where there is no sample
 * \param[in] significance standard deviations that make a group positive
 */
std::vector<BinGroup>
findSalientGroups(const Eigen::MatrixXd& scores, double significance);

} // namespace nurbs
} // namespace pcl
