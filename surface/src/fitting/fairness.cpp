// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "fairness.h"

#include <array>

namespace pcl {
namespace nurbs {
namespace {

/** Gram matrices of the derivatives 0, 1, 2 of the basis functions of one cell. */
using DerivativeGrams = std::array<Eigen::MatrixXd, 3>;

/** Chebyshev coefficients of the derivative of sum c_k T_k, one row per function:
 * c'_{k-1} = c'_{k+1} + 2 k c_k, with c'_0 halved. */
Eigen::MatrixXd
differentiate(const Eigen::MatrixXd& coefficients)
{
  const Eigen::Index n = coefficients.cols();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(coefficients.rows(), n);
  for (Eigen::Index k = n - 1; k >= 1; --k) {
    result.col(k - 1) = 2.0 * static_cast<double>(k) * coefficients.col(k);
    if (k + 1 < n)
      result.col(k - 1) += result.col(k + 1);
  }
  result.col(0) *= 0.5;
  return result;
}

/** Integral over [-1, 1] of T_i T_k; the one of T_m is 2 / (1 - m^2) for even m. */
Eigen::MatrixXd
chebyshevProductIntegrals(Eigen::Index n)
{
  const auto integral = [](Eigen::Index m) {
    return m % 2 != 0 ? 0.0 : 2.0 / (1.0 - static_cast<double>(m * m));
  };
  Eigen::MatrixXd result(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      result(i, k) = 0.5 * (integral(i + k) + integral(i > k ? i - k : k - i));
  return result;
}

std::vector<DerivativeGrams>
derivativeGrams(const KnotCells& cells)
{
  const Eigen::MatrixXd integrals = chebyshevProductIntegrals(cells.degree() + 1);
  const double domain = cells.end(cells.count() - 1) - cells.begin(0);
  std::vector<DerivativeGrams> result(static_cast<std::size_t>(cells.count()));
  for (int cell = 0; cell < cells.count(); ++cell) {
    const double half = 0.5 * (cells.end(cell) - cells.begin(cell)) / domain;
    Eigen::MatrixXd values = cells.chebyshev(cell);
    double scale = half; // d/du = (1 / half) d/dx, squared, times du = half dx
    for (Eigen::MatrixXd& gram : result[static_cast<std::size_t>(cell)]) {
      gram = scale * values * integrals * values.transpose();
      values = differentiate(values);
      scale /= half * half;
    }
  }
  return result;
}

/** Calls visit(cell, energy matrix) with the exact energy over each cell. */
template <typename Visitor>
void
forEachCellEnergy(const CellPoints& points,
                  const FairnessWeights& weights,
                  Visitor visit)
{
  const std::vector<DerivativeGrams> grams_u = derivativeGrams(points.cells_u);
  const std::vector<DerivativeGrams> grams_v = derivativeGrams(points.cells_v);
  const int size_v = points.cells_v.degree() + 1;
  const int size = (points.cells_u.degree() + 1) * size_v;
  Eigen::MatrixXd energy(size, size);
  for (int cell = 0; cell < points.numCells(); ++cell) {
    const int b = points.cells_v.count();
    const DerivativeGrams& u = grams_u[static_cast<std::size_t>(cell / b)];
    const DerivativeGrams& v = grams_v[static_cast<std::size_t>(cell % b)];
    for (int i = 0; i <= points.cells_u.degree(); ++i)
      for (int k = 0; k <= points.cells_u.degree(); ++k)
        energy.block(i * size_v, k * size_v, size_v, size_v) =
            (weights.thin_plate * u[2](i, k) + weights.membrane * u[1](i, k)) * v[0] +
            (2.0 * weights.thin_plate * u[1](i, k) + weights.membrane * u[0](i, k)) *
                v[1] +
            weights.thin_plate * u[0](i, k) * v[2];
    visit(cell, energy);
  }
}

} // namespace

void
addFairness(const CellPoints& points,
            const FairnessWeights& weights,
            std::vector<CellEquations>& cells)
{
  forEachCellEnergy(points, weights, [&](int cell, const Eigen::MatrixXd& energy) {
    cells[static_cast<std::size_t>(cell)].gram += energy;
  });
}

void
addFairnessAround(const CellPoints& points,
                  const FairnessWeights& weights,
                  const Eigen::MatrixXd& unknowns,
                  bool derivatives,
                  std::vector<CellEquations>& cells)
{
  const Eigen::Index channels = unknowns.rows();
  forEachCellEnergy(points, weights, [&](int cell, const Eigen::MatrixXd& energy) {
    CellEquations& equations = cells[static_cast<std::size_t>(cell)];
    const std::vector<int> controls = points.controls(cell);
    Eigen::MatrixXd local(energy.rows(), channels);
    for (std::size_t i = 0; i < controls.size(); ++i)
      local.row(static_cast<Eigen::Index>(i)) = unknowns.col(controls[i]).transpose();
    const Eigen::MatrixXd force = energy * local;
    equations.constant(0) += local.cwiseProduct(force).sum();
    for (Eigen::Index row = 0; derivatives && row < energy.rows(); ++row)
      for (Eigen::Index a = 0; a < channels; ++a) {
        equations.rhs(row * channels + a, 0) -= force(row, a);
        for (Eigen::Index column = 0; column < energy.rows(); ++column)
          equations.gram(row * channels + a, column * channels + a) +=
              energy(row, column);
      }
  });
}

} // namespace nurbs
} // namespace pcl
