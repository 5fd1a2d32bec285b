// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/view_polynomial.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr auto kTerms = static_cast<std::size_t>(kMostViewTerms);

/** A pivot smaller than this share of its diagonal is rounding; its unknown is 0. */
constexpr double kRank = 1e-12;

} // namespace

ViewFit::ViewFit(const ViewSums& sums) : sums_(sums)
{
  misfit_[0] = sums.squares();
}

void
ViewFit::extend(std::size_t terms)
{
  for (; done_ < terms; ++done_) {
    std::array<double, kTerms>& row = factor_[done_];
    double pivot = sums_.normal(done_, done_);
    double right = sums_.right(done_);
    for (std::size_t j = 0; j < done_; ++j) {
      double sum = sums_.normal(done_, j);
      for (std::size_t k = 0; k < j; ++k)
        sum -= row[k] * factor_[j][k];
      row[j] = sum * inverse_[j];
      pivot -= row[j] * row[j];
      right -= row[j] * reduced_[j];
    }
    const bool used_up = !(pivot > kRank * sums_.normal(done_, done_));
    inverse_[done_] = used_up ? 0.0 : 1.0 / std::sqrt(pivot);
    reduced_[done_] = right * inverse_[done_];
    misfit_[done_ + 1] = misfit_[done_] - reduced_[done_] * reduced_[done_];
  }
}

double
ViewFit::misfit(int terms)
{
  extend(static_cast<std::size_t>(terms));
  return std::max(0.0, misfit_[static_cast<std::size_t>(terms)]);
}

ViewPolynomial
ViewFit::solve(int terms)
{
  const auto n = static_cast<std::size_t>(terms);
  extend(n);
  ViewPolynomial result;
  result.terms = terms;
  std::array<double, kTerms>& x = result.coefficients;
  for (std::size_t i = n; i-- > 0;) {
    double sum = reduced_[i];
    for (std::size_t k = i + 1; k < n; ++k)
      sum -= factor_[k][i] * x[k];
    x[i] = sum * inverse_[i];
  }
  return result;
}

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
  return ViewFit(*this).solve(terms);
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
