// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "normal_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

#include <numeric>

namespace pcl {
namespace nurbs {
namespace {

/** Below this size a dense factor is faster than the bookkeeping of a sparse one. */
constexpr Eigen::Index kDenseLimit = 128;

/** Positions of the entries of a control point's row: neighbours up to one degree away.
 */
Eigen::SparseMatrix<double>
emptyBandMatrix(const CellPoints& points)
{
  const int n_v = points.cells_v.numControlPoints();
  const Eigen::Index n = points.numControlPoints();
  const int band =
      (2 * points.cells_u.degree() + 1) * (2 * points.cells_v.degree() + 1);
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.reserve(Eigen::VectorXi::Constant(n, band));
  for (int column = 0; column < n; ++column)
    for (int i = -points.cells_u.degree(); i <= points.cells_u.degree(); ++i)
      for (int j = -points.cells_v.degree(); j <= points.cells_v.degree(); ++j) {
        const int u = column / n_v + i;
        const int v = column % n_v + j;
        if (u >= 0 && u < points.cells_u.numControlPoints() && v >= 0 && v < n_v)
          matrix.insert(u * n_v + v, column) = 0.0;
      }
  matrix.makeCompressed();
  return matrix;
}

bool
solveDense(const Eigen::MatrixXd& gram, const Eigen::MatrixXd& rhs, Eigen::MatrixXd& x)
{
  const Eigen::LLT<Eigen::MatrixXd> factor(gram);
  if (factor.info() != Eigen::Success)
    return false;
  x = factor.solve(rhs);
  return x.allFinite();
}

bool
solveSparse(const Eigen::SparseMatrix<double>& gram,
            const Eigen::MatrixXd& rhs,
            Eigen::MatrixXd& x)
{
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(gram);
  if (factor.info() != Eigen::Success)
    return false;
  x = factor.solve(rhs);
  return x.allFinite();
}

} // namespace

NormalEquations::NormalEquations(const CellPoints& points,
                                 const std::vector<CellEquations>& cells)
{
  const Eigen::Index n = points.numControlPoints();
  const Eigen::Index columns = cells.front().rhs.cols();
  rhs_ = Eigen::MatrixXd::Zero(n, columns);
  constant_ = Eigen::VectorXd::Zero(columns);
  gram_ = emptyBandMatrix(points);
  const Eigen::Index run = points.cells_v.degree() + 1;
  for (int cell = 0; cell < points.numCells(); ++cell) {
    const CellEquations& equations = cells[static_cast<std::size_t>(cell)];
    const std::vector<int> controls = points.controls(cell);
    constant_ += equations.constant;
    for (std::size_t k = 0; k < controls.size(); ++k) {
      rhs_.row(controls[k]) += equations.rhs.row(static_cast<Eigen::Index>(k));
      // A run of q + 1 control points is contiguous in the column's storage as well.
      for (std::size_t i = 0; i < controls.size(); i += static_cast<std::size_t>(run)) {
        double* target = &gram_.coeffRef(controls[i], controls[k]);
        for (Eigen::Index j = 0; j < run; ++j)
          target[j] += equations.gram(static_cast<Eigen::Index>(i) + j,
                                      static_cast<Eigen::Index>(k));
      }
    }
  }
}

bool
NormalEquations::solve(const std::vector<bool>& fixed, Eigen::MatrixXd& unknowns) const
{
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < gram_.cols(); ++i)
    if (fixed.empty() || !fixed[static_cast<std::size_t>(i)])
      free.push_back(i);
  if (free.empty())
    return true;
  const auto n = static_cast<Eigen::Index>(free.size());
  const bool all = n == gram_.cols();
  Eigen::MatrixXd solution;
  bool solved = false;
  if (all) {
    solved = n <= kDenseLimit ? solveDense(gram_, rhs_, solution)
                              : solveSparse(gram_, rhs_, solution);
  }
  else {
    Eigen::SparseMatrix<double> select(gram_.cols(), n);
    for (Eigen::Index k = 0; k < n; ++k)
      select.insert(free[static_cast<std::size_t>(k)], k) = 1.0;
    Eigen::MatrixXd known = unknowns;
    for (Eigen::Index i : free)
      known.row(i).setZero();
    const Eigen::MatrixXd rhs = select.transpose() * (rhs_ - gram_ * known);
    solved = solveSparse(select.transpose() * gram_ * select, rhs, solution);
  }
  for (Eigen::Index k = 0; solved && k < n; ++k)
    unknowns.row(free[static_cast<std::size_t>(k)]) = solution.row(k);
  return solved;
}

Eigen::VectorXd
NormalEquations::value(const Eigen::MatrixXd& unknowns) const
{
  const Eigen::MatrixXd half = gram_ * unknowns - 2.0 * rhs_;
  return (unknowns.cwiseProduct(half)).colwise().sum().transpose() + constant_;
}

} // namespace nurbs
} // namespace pcl
