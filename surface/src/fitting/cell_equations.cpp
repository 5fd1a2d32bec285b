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

using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/** Chebyshev coefficients of the products of two basis functions of a cell, one row per
 * pair (r, k <= r), by T_i T_j = (T_{i+j} + T_{|i-j|}) / 2. */
Table
basisProducts(const Eigen::MatrixXd& basis)
{
  const Eigen::Index size = basis.rows();
  Table result = Table::Zero(size * (size + 1) / 2, 2 * size - 1);
  for (Eigen::Index r = 0, pair = 0; r < size; ++r)
    for (Eigen::Index k = 0; k <= r; ++k, ++pair)
      for (Eigen::Index i = 0; i < size; ++i)
        for (Eigen::Index j = 0; j < size; ++j) {
          const double half = 0.5 * basis(r, i) * basis(k, j);
          result(pair, i + j) += half;
          result(pair, std::abs(i - j)) += half;
        }
  return result;
}

/** Basis functions and their products in every cell of one direction. */
struct DirectionTables {
  explicit DirectionTables(const KnotCells& cells)
  {
    for (int cell = 0; cell < cells.count(); ++cell) {
      basis.emplace_back(cells.chebyshev(cell));
      products.push_back(basisProducts(cells.chebyshev(cell)));
    }
  }

  std::vector<Table> basis;
  std::vector<Table> products;
};

/** Reduces one cell after the other with its scratch memory kept. */
class CellReducer {
public:
  CellReducer(const CellPoints& points,
              const PointRows& rows,
              const DirectionTables& tables_u,
              const DirectionTables& tables_v)
      : points_(points),
        rows_(rows),
        tables_u_(tables_u),
        tables_v_(tables_v),
        p_(points.cells_u.degree()),
        q_(points.cells_v.degree()),
        degree_(std::max(p_, q_)),
        size_((p_ + 1) * (q_ + 1))
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
    cell_u_ = static_cast<std::size_t>(cell / points_.cells_v.count());
    cell_v_ = static_cast<std::size_t>(cell % points_.cells_v.count());
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

  /** Moments up to the given degrees as a matrix. */
  auto
  moments(int degree_u, int degree_v, int stride) const
  {
    return Eigen::Map<const Table, 0, Eigen::OuterStride<>>(
        table_.data(), degree_u + 1, degree_v + 1, Eigen::OuterStride<>(stride));
  }

  /** Sums over the points of all products of four basis functions, two of each
   * direction: one direction after the other. */
  void
  addGram(int begin, int count, int pair, int row, int column, Eigen::MatrixXd& gram)
  {
    sumMoments(2 * degree_, begin, count, rows_.gram.col(pair).data());
    const Table& products_u = tables_u_.products[cell_u_];
    const Table& products_v = tables_v_.products[cell_v_];
    half_.noalias() =
        products_u.lazyProduct(moments(2 * p_, 2 * q_, momentStride(2 * degree_)));
    pairs_.noalias() = half_.lazyProduct(products_v.transpose());
    for (int r = 0, pair_u = 0; r <= p_; ++r)
      for (int k = 0; k <= r; ++k, ++pair_u) {
        scatter(pair_u, r, k, row, column, gram);
        if (k != r)
          scatter(pair_u, k, r, row, column, gram);
      }
  }

  /** Entries of the pair (r, k) of functions of u in both triangles. */
  void
  scatter(int pair_u, int r, int k, int row, int column, Eigen::MatrixXd& gram) const
  {
    const int c = rows_.channels;
    const double* value = &pairs_(pair_u, 0);
    for (int s = 0; s <= q_; ++s)
      for (int l = 0; l <= s; ++l, ++value) {
        const int first = r * (q_ + 1);
        const int second = k * (q_ + 1);
        gram((first + s) * c + row, (second + l) * c + column) = *value;
        gram((first + l) * c + row, (second + s) * c + column) = *value;
        if (row != column) {
          gram((second + l) * c + column, (first + s) * c + row) = *value;
          gram((second + s) * c + column, (first + l) * c + row) = *value;
        }
      }
  }

  void
  addRightHandSide(int begin, int count, int channel, int k, Eigen::MatrixXd& rhs)
  {
    const int column = channel * rows_.right_hand_sides + k;
    sumMoments(degree_, begin, count, rows_.moments.col(column).data());
    half_.noalias() =
        tables_u_.basis[cell_u_].lazyProduct(moments(p_, q_, momentStride(degree_)));
    pairs_.noalias() = half_.lazyProduct(tables_v_.basis[cell_v_].transpose());
    for (int i = 0; i < size_; ++i)
      rhs(i * rows_.channels + channel, k) = pairs_.data()[i];
  }

  const CellPoints& points_;
  const PointRows& rows_;
  const DirectionTables& tables_u_;
  const DirectionTables& tables_v_;
  int p_, q_, degree_, size_;
  std::size_t cell_u_ = 0;
  std::size_t cell_v_ = 0;
  Eigen::VectorXd table_;
  Table half_;  // the direction of u is done
  Table pairs_; // both are
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
  const DirectionTables tables_u(points.cells_u);
  const DirectionTables tables_v(points.cells_v);
#pragma omp parallel num_threads(threads) if (threads > 1)
  {
    CellReducer reducer(points, rows, tables_u, tables_v);
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
