// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "cell_equations.h"

#include "chebyshev_moments.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** Moment tables of a Gram matrix: entry ((i, j), (k, l)) of the tensor-product
 * Chebyshev basis, by T_i T_k = (T_{i+k} + T_{|i-k|}) / 2 in both directions. */
void
chebyshevGram(const double* table, int stride, int p, int q, Eigen::MatrixXd& gram)
{
  const auto at = [=](int a, int b) { return table[a * stride + b]; };
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j <= q; ++j)
      for (int k = 0; k <= i; ++k)
        for (int l = 0; l <= q; ++l) {
          const int dj = std::abs(j - l);
          const double value = 0.25 * (at(i + k, j + l) + at(i - k, j + l) +
                                       at(i + k, dj) + at(i - k, dj));
          gram(i * (q + 1) + j, k * (q + 1) + l) = value;
          gram(k * (q + 1) + l, i * (q + 1) + j) = value;
        }
}

/** Tensor product of the Chebyshev coefficients of both directions. */
Eigen::MatrixXd
basisTransform(const Eigen::MatrixXd& u, const Eigen::MatrixXd& v)
{
  Eigen::MatrixXd result(u.rows() * v.rows(), u.cols() * v.cols());
  for (Eigen::Index r = 0; r < u.rows(); ++r)
    for (Eigen::Index c = 0; c < u.cols(); ++c)
      result.block(r * v.rows(), c * v.cols(), v.rows(), v.cols()) = u(r, c) * v;
  return result;
}

/** Reduces one cell after the other with its scratch memory kept. */
class CellReducer {
public:
  CellReducer(const CellPoints& points, const PointRows& rows)
      : points_(points),
        rows_(rows),
        p_(points.cells_u.degree()),
        q_(points.cells_v.degree()),
        degree_(std::max(p_, q_)),
        size_((p_ + 1) * (q_ + 1)),
        chebyshev_(size_, size_)
  {
  }

  void
  reduce(int cell, CellEquations& result)
  {
    const int c = rows_.channels;
    result.gram.setZero(size_ * c, size_ * c);
    result.rhs.setZero(size_ * c, rows_.right_hand_sides);
    const int begin = points_.begin[static_cast<std::size_t>(cell)];
    const int count = points_.begin[static_cast<std::size_t>(cell) + 1] - begin;
    result.constant = rows_.squares.middleRows(begin, count).colwise().sum();
    if (count == 0)
      return;
    const int b = points_.cells_v.count();
    transform_ = basisTransform(points_.cells_u.chebyshev(cell / b),
                                points_.cells_v.chebyshev(cell % b));
    for (int row = 0, pair = 0; row < c; ++row)
      for (int column = row; column < c; ++column, ++pair)
        addGram(begin, count, pair, row, column, result.gram);
    for (int row = 0; row < c; ++row)
      for (int k = 0; k < rows_.right_hand_sides; ++k)
        addRightHandSide(begin, count, row, k, result.rhs);
  }

private:
  void
  sumMoments(int degree, int begin, int count, const double* weights)
  {
    table_.setZero((degree + 1) * momentStride(degree));
    addChebyshevMoments(degree,
                        count,
                        points_.s.data() + begin,
                        points_.t.data() + begin,
                        weights + begin,
                        table_.data());
  }

  void
  addGram(int begin, int count, int pair, int row, int column, Eigen::MatrixXd& gram)
  {
    sumMoments(2 * degree_, begin, count, rows_.gram.col(pair).data());
    chebyshevGram(table_.data(), momentStride(2 * degree_), p_, q_, chebyshev_);
    product_.noalias() = transform_ * chebyshev_;
    block_.noalias() = product_ * transform_.transpose();
    const int c = rows_.channels;
    for (int i = 0; i < size_; ++i)
      for (int k = 0; k < size_; ++k) {
        gram(i * c + row, k * c + column) = block_(i, k);
        gram(k * c + column, i * c + row) = block_(i, k);
      }
  }

  void
  addRightHandSide(int begin, int count, int channel, int k, Eigen::MatrixXd& rhs)
  {
    const int column = channel * rows_.right_hand_sides + k;
    sumMoments(degree_, begin, count, rows_.moments.col(column).data());
    const int stride = momentStride(degree_);
    Eigen::VectorXd sums(size_);
    for (int i = 0; i <= p_; ++i)
      for (int j = 0; j <= q_; ++j)
        sums(i * (q_ + 1) + j) = table_(i * stride + j);
    const Eigen::VectorXd values = transform_ * sums;
    for (int i = 0; i < size_; ++i)
      rhs(i * rows_.channels + channel, k) = values(i);
  }

  const CellPoints& points_;
  const PointRows& rows_;
  int p_, q_, degree_, size_;
  Eigen::MatrixXd chebyshev_, transform_, product_, block_;
  Eigen::VectorXd table_;
};

} // namespace

CellPoints::CellPoints(const KnotVector& knots_u,
                       const KnotVector& knots_v,
                       const Eigen::Matrix2Xd& parameters)
    : cells_u(knots_u), cells_v(knots_v)
{
  const auto count = static_cast<std::size_t>(parameters.cols());
  std::vector<int> cell_of(count);
  begin.assign(static_cast<std::size_t>(numCells()) + 1, 0);
  for (std::size_t n = 0; n < count; ++n) {
    const auto column = parameters.col(static_cast<Eigen::Index>(n));
    cell_of[n] =
        cells_u.locate(column.x()) * cells_v.count() + cells_v.locate(column.y());
    ++begin[static_cast<std::size_t>(cell_of[n]) + 1];
  }
  for (std::size_t cell = 0; cell + 1 < begin.size(); ++cell)
    begin[cell + 1] += begin[cell];
  order.resize(count);
  s.resize(count);
  t.resize(count);
  std::vector<int> next(begin);
  for (std::size_t n = 0; n < count; ++n) {
    const int cell = cell_of[n];
    const auto column = parameters.col(static_cast<Eigen::Index>(n));
    const auto position =
        static_cast<std::size_t>(next[static_cast<std::size_t>(cell)]++);
    order[position] = static_cast<int>(n);
    s[position] = cells_u.local(cell / cells_v.count(), column.x());
    t[position] = cells_v.local(cell % cells_v.count(), column.y());
  }
}

std::vector<int>
CellPoints::controls(int cell) const
{
  const int first_u = cells_u.firstControl(cell / cells_v.count());
  const int first_v = cells_v.firstControl(cell % cells_v.count());
  std::vector<int> result;
  for (int i = 0; i <= cells_u.degree(); ++i)
    for (int j = 0; j <= cells_v.degree(); ++j)
      result.push_back((first_u + i) * cells_v.numControlPoints() + first_v + j);
  return result;
}

std::vector<CellEquations>
reduceCells(const CellPoints& points, const PointRows& rows, int threads)
{
  std::vector<CellEquations> cells(static_cast<std::size_t>(points.numCells()));
#pragma omp parallel num_threads(threads) if (threads > 1)
  {
    CellReducer reducer(points, rows);
#pragma omp for schedule(dynamic, 8)
    for (int cell = 0; cell < points.numCells(); ++cell)
      reducer.reduce(cell, cells[static_cast<std::size_t>(cell)]);
  }
  return cells;
}

TriangularCell
factorizeCell(const CellEquations& cell)
{
  // gram = P' L D L' P with decreasing D: what is left of D at rounding level carries
  // no information and is dropped, so a cell with few points gives few rows.
  constexpr double kRoundingLevel = 1e-13;
  TriangularCell result;
  if (cell.gram.size() == 0) { // only the cost was asked for
    result.R.resize(0, 0);
    result.d.resize(0, cell.constant.size());
    result.rest = cell.constant;
    return result;
  }
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(cell.gram);
  const Eigen::VectorXd pivots = ldlt.vectorD();
  const double smallest = kRoundingLevel * std::max(pivots.maxCoeff(), 0.0);
  Eigen::Index rank = 0;
  while (rank < pivots.size() && pivots(rank) > smallest)
    ++rank;
  const Eigen::VectorXd roots = pivots.head(rank).cwiseSqrt();
  const Eigen::MatrixXd lower = ldlt.matrixL();
  Eigen::MatrixXd forward = ldlt.transpositionsP() * cell.rhs;
  ldlt.matrixL().solveInPlace(forward);

  result.R = roots.asDiagonal() * lower.leftCols(rank).transpose();
  result.R =
      result.R * Eigen::PermutationMatrix<Eigen::Dynamic>(ldlt.transpositionsP());
  result.d = roots.cwiseInverse().asDiagonal() * forward.topRows(rank);
  result.rest =
      (cell.constant - result.d.colwise().squaredNorm().transpose()).cwiseMax(0.0);
  return result;
}

} // namespace nurbs
} // namespace pcl
