// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "knot_cells.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kPi = 3.14159265358979323846;

/** Chebyshev coefficients of the basis functions of one span: they are polynomials of
 * degree p, so the discrete cosine transform of their values at the p + 1 Chebyshev
 * points is exact. */
Eigen::MatrixXd
chebyshevCoefficients(const KnotVector& knots, int span)
{
  const int p = knots.degree();
  const double middle = 0.5 * (knots[span] + knots[span + 1]);
  const double half = 0.5 * (knots[span + 1] - knots[span]);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(p + 1, p + 1);
  for (int node = 0; node <= p; ++node) {
    const double angle = kPi * (node + 0.5) / (p + 1);
    BasisValues values;
    knots.evaluateBasis(span, middle + half * std::cos(angle), values);
    for (int i = 0; i <= p; ++i) {
      const double factor = (i == 0 ? 1.0 : 2.0) / (p + 1) * std::cos(i * angle);
      for (int r = 0; r <= p; ++r)
        result(r, i) += factor * values[static_cast<std::size_t>(r)];
    }
  }
  return result;
}

} // namespace

KnotCells::KnotCells(const KnotVector& knots)
    : degree_(knots.degree()),
      num_control_points_(knots.numControlPoints()),
      breaks_(knots.breaks())
{
  for (std::size_t cell = 0; cell + 1 < breaks_.size(); ++cell) {
    const int span = knots.findSpan(0.5 * (breaks_[cell] + breaks_[cell + 1]));
    first_control_.push_back(span - degree_);
    chebyshev_.push_back(chebyshevCoefficients(knots, span));
  }
  fillBuckets();
}

void
KnotCells::fillBuckets()
{
  constexpr int kBucketsPerCell = 4;
  const int buckets = kBucketsPerCell * count();
  const double length = breaks_.back() - breaks_.front();
  buckets_per_length_ = buckets / length;
  int cell = 0;
  for (int k = 0; k < buckets; ++k) {
    while (cell + 1 < count() && end(cell) <= breaks_.front() + k * length / buckets)
      ++cell;
    bucket_.push_back(cell);
  }
}

int
KnotCells::locate(double u) const
{
  const double position = (u - breaks_.front()) * buckets_per_length_;
  const double last = static_cast<double>(bucket_.size() - 1);
  int cell = bucket_[static_cast<std::size_t>(std::clamp(position, 0.0, last))];
  while (cell > 0 && u < begin(cell)) // a bucket's first cell may be rounded up
    --cell;
  while (cell + 1 < count() && u >= end(cell))
    ++cell;
  return cell;
}

} // namespace nurbs
} // namespace pcl
