// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "sample_grid.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Lattice with about \a target bins whose shape follows the occupied part of the
 * domain: a first coarse lattice tells how much of the domain has points at all. */
std::pair<int, int>
latticeShape(const Eigen::Vector2d& extent, int target)
{
  const double aspect = std::clamp(extent.x() / extent.y(), 0.02, 50.0);
  const double columns = std::sqrt(target / aspect);
  return {std::max(1, static_cast<int>(std::lround(columns * aspect))),
          std::max(1, static_cast<int>(std::lround(columns)))};
}

constexpr int kWindow = 4;          // bins on a side
constexpr int kFewestInWindow = 12; // a quadratic has 6 coefficients

/** Variance of samples of unit weight around the quadratic that fits a window best.
 * Centroids are not on a lattice, so plain differences would see the slope of the
 * surface. */
double
varianceAroundQuadratic(const SampleGrid& grid, const std::vector<int>& window)
{
  constexpr int kTerms = 6;
  const auto n = static_cast<Eigen::Index>(window.size());
  Eigen::MatrixXd rows(n, kTerms);
  Eigen::MatrixXd values(n, grid.values.cols());
  for (Eigen::Index k = 0; k < n; ++k) {
    const int sample = window[static_cast<std::size_t>(k)];
    const Eigen::Vector2d x =
        (grid.parameters.col(sample) - grid.parameters.col(window.front()))
            .cwiseQuotient(kWindow * grid.bin_size);
    const double root = std::sqrt(grid.weights(sample));
    rows.row(k) << 1.0, x(0), x(1), x(0) * x(0), x(0) * x(1), x(1) * x(1);
    rows.row(k) *= root;
    values.row(k) = root * grid.values.row(sample);
  }
  const Eigen::MatrixXd residual =
      values - rows * rows.colPivHouseholderQr().solve(values);
  const double freedom = static_cast<double>((n - kTerms) * grid.values.cols());
  // So that the median of many is not too low (Wilson-Hilferty).
  const double median_of_chi_squared =
      freedom * std::pow(1.0 - 2.0 / (9.0 * freedom), 3);
  return residual.squaredNorm() / median_of_chi_squared;
}

double
median(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace

SampleGrid::SampleGrid(const Eigen::Vector2d& low,
                       const Eigen::Vector2d& high,
                       const Eigen::Matrix2Xd& parameters,
                       const Eigen::MatrixXd& values,
                       const Eigen::VectorXd& weights,
                       int target_samples)
    : low(low)
{
  std::tie(rows, columns) = latticeShape(high - low, target_samples);
  bin_size = (high - low).cwiseQuotient(Eigen::Vector2d(rows, columns));
  const auto bins = static_cast<Eigen::Index>(rows) * columns;
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(3 + values.cols(), bins);
  for (Eigen::Index n = 0; n < parameters.cols(); ++n) {
    const Eigen::Vector2d cell =
        (parameters.col(n) - low).cwiseQuotient(bin_size).array().floor();
    const int row = std::clamp(static_cast<int>(cell.x()), 0, rows - 1);
    const int column = std::clamp(static_cast<int>(cell.y()), 0, columns - 1);
    auto sum = sums.col(static_cast<Eigen::Index>(row) * columns + column);
    sum(0) += weights(n);
    sum.segment<2>(1) += weights(n) * parameters.col(n);
    sum.tail(values.cols()) += weights(n) * values.row(n).transpose();
  }
  for (Eigen::Index k = 0; k < bins; ++k)
    if (sums(0, k) > 0.0)
      bin.push_back(static_cast<int>(k));
  const auto count = static_cast<Eigen::Index>(bin.size());
  this->parameters.resize(2, count);
  this->values.resize(count, values.cols());
  this->weights.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto sum = sums.col(bin[static_cast<std::size_t>(k)]);
    this->weights(k) = sum(0);
    this->parameters.col(k) = sum.segment<2>(1) / sum(0);
    this->values.row(k) = sum.tail(values.cols()).transpose() / sum(0);
  }
}

double
SampleGrid::noise() const
{
  std::vector<int> sample_of(static_cast<std::size_t>(rows) * columns, -1);
  for (std::size_t k = 0; k < bin.size(); ++k)
    sample_of[static_cast<std::size_t>(bin[k])] = static_cast<int>(k);
  std::vector<double> variances;
  for (int i = 0; i + kWindow <= rows; i += kWindow)
    for (int j = 0; j + kWindow <= columns; j += kWindow) {
      std::vector<int> window;
      for (int k = 0; k < kWindow * kWindow; ++k) {
        const int at = (i + k / kWindow) * columns + j + k % kWindow;
        const int sample = sample_of[static_cast<std::size_t>(at)];
        if (sample >= 0)
          window.push_back(sample);
      }
      if (static_cast<int>(window.size()) >= kFewestInWindow)
        variances.push_back(varianceAroundQuadratic(*this, window));
    }
  return variances.empty() ? 0.0 : std::sqrt(median(variances));
}

} // namespace nurbs
} // namespace pcl
