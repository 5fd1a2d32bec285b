// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "band_cholesky.h"

#include <pcl/surface/nurbs/runtime_simd.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** Right-looking: each column is scaled and taken off the columns that follow.
 * \param[in,out] columns \a stride values per column, the diagonal first */
PCL_NURBS_RUNTIME_SIMD bool
factorizeBand(double* columns, int size, int stride)
{
  for (int j = 0; j < size; ++j) {
    double* pivot = columns + static_cast<std::ptrdiff_t>(j) * stride;
    if (!(pivot[0] > 0.0) || !std::isfinite(pivot[0]))
      return false;
    const double inverse = 1.0 / std::sqrt(pivot[0]);
    const int below = std::min(stride, size - j);
    for (int d = 0; d < below; ++d)
      pivot[d] *= inverse;
    for (int d = 1; d < below; ++d) {
      const double factor = pivot[d];
      const double* from = pivot + d;
      double* to = pivot + static_cast<std::ptrdiff_t>(d) * stride;
      for (int k = 0; k < below - d; ++k)
        to[k] -= factor * from[k];
    }
  }
  return true;
}

} // namespace

bool
BandMatrix::factorize()
{
  return factorizeBand(columns_.data(),
                       static_cast<int>(columns_.cols()),
                       static_cast<int>(columns_.rows()));
}

void
BandMatrix::solveInPlace(Eigen::MatrixXd& x) const
{
  const Eigen::Index n = size();
  for (Eigen::Index right = 0; right < x.cols(); ++right) {
    auto values = x.col(right);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Index below = std::min(width(), n - 1 - j);
      values(j) /= columns_(0, j);
      values.segment(j + 1, below) -= values(j) * columns_.col(j).segment(1, below);
    }
    for (Eigen::Index j = n - 1; j >= 0; --j) {
      const Eigen::Index below = std::min(width(), n - 1 - j);
      values(j) -= columns_.col(j).segment(1, below).dot(values.segment(j + 1, below));
      values(j) /= columns_(0, j);
    }
  }
}

} // namespace nurbs
} // namespace pcl
