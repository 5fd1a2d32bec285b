// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/view_polynomial.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr auto kTerms = static_cast<std::size_t>(kMostViewTerms);

/** Cholesky factor of the leading part of a normal matrix, in place; a pivot that
 * rounding has used up is replaced by a huge one, which leaves its unknown near zero.
 */
void
factorize(std::array<std::array<double, kTerms>, kTerms>& a, std::size_t n)
{
  constexpr double kRank = 1e-12;
  for (std::size_t j = 0; j < n; ++j) {
    const double diagonal = a[j][j];
    double pivot = diagonal;
    for (std::size_t k = 0; k < j; ++k)
      pivot -= a[j][k] * a[j][k];
    const bool used_up = !(pivot > kRank * diagonal);
    a[j][j] = used_up ? 0.0 : std::sqrt(pivot);
    for (std::size_t i = j + 1; i < n; ++i) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k)
        sum -= a[i][k] * a[j][k];
      a[i][j] = used_up ? 0.0 : sum / a[j][j];
    }
  }
}

} // namespace

void
ViewSums::add(const ViewSample& sample)
{
  std::size_t at = 0;
  for (std::size_t i = 0; i < kTerms; ++i) {
    const double weighted = sample.weight * sample.basis[i];
    for (std::size_t j = 0; j <= i; ++j)
      sums_[at++] += weighted * sample.basis[j];
    sums_[kRight + i] += weighted * sample.value;
  }
  sums_[kSquares] += sample.weight * sample.value * sample.value;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sums_[kDirection + axis] +=
        sample.weight * sample.direction(static_cast<Eigen::Index>(axis));
  sums_[kWeight] += sample.weight;
  sums_[kCount] += 1.0;
}

ViewSums&
ViewSums::operator+=(const ViewSums& other)
{
  for (std::size_t k = 0; k < sums_.size(); ++k)
    sums_[k] += other.sums_[k];
  return *this;
}

ViewPolynomial
ViewSums::fit(int terms) const
{
  const auto n = static_cast<std::size_t>(terms);
  std::array<std::array<double, kTerms>, kTerms> factor;
  std::size_t at = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      factor[i][j] = sums_[at++];
  factorize(factor, n);
  ViewPolynomial result;
  result.terms = terms;
  std::array<double, kTerms>& x = result.coefficients;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = sums_[kRight + i];
    for (std::size_t k = 0; k < i; ++k)
      sum -= factor[i][k] * x[k];
    x[i] = factor[i][i] > 0.0 ? sum / factor[i][i] : 0.0;
  }
  for (std::size_t i = n; i-- > 0;) {
    double sum = x[i];
    for (std::size_t k = i + 1; k < n; ++k)
      sum -= factor[k][i] * x[k];
    x[i] = factor[i][i] > 0.0 ? sum / factor[i][i] : 0.0;
  }
  return result;
}

double
ViewSums::misfit(const ViewPolynomial& surface) const
{
  const std::array<double, kTerms>& x = surface.coefficients;
  const auto n = static_cast<std::size_t>(surface.terms);
  double quadratic = 0.0;
  double linear = 0.0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double row = 0.0;
    for (std::size_t j = 0; j < i; ++j)
      row += 2.0 * sums_[at++] * x[j];
    row += sums_[at++] * x[i];
    quadratic += row * x[i];
    linear += sums_[kRight + i] * x[i];
  }
  return std::max(0.0, sums_[kSquares] - 2.0 * linear + quadratic);
}

Eigen::Vector3d
ViewSums::meanDirection() const
{
  const double weight = sums_[kWeight] > 0.0 ? sums_[kWeight] : 1.0;
  return Eigen::Vector3d(
             sums_[kDirection], sums_[kDirection + 1], sums_[kDirection + 2]) /
         weight;
}

} // namespace nurbs
} // namespace pcl
