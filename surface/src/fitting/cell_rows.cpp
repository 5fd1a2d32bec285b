// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "cell_rows.h"

#include <Eigen/QR>

#include <algorithm>

namespace pcl {
namespace nurbs {
namespace {

/** Values of the (p + 1)(q + 1) basis functions of a cell at one of its points. */
class CellBasis {
public:
  CellBasis(const CellPoints& points, int cell)
      : points_(points),
        u_(points.cells_u.chebyshev(cell / points.cells_v.count())),
        v_(points.cells_v.chebyshev(cell % points.cells_v.count()))
  {
  }

  Eigen::Index
  size() const
  {
    return u_.rows() * v_.rows();
  }

  void
  evaluate(std::size_t position, Eigen::VectorXd& values) const
  {
    const Eigen::VectorXd u = u_ * chebyshev(points_.s[position], u_.cols());
    const Eigen::VectorXd v = v_ * chebyshev(points_.t[position], v_.cols());
    values.resize(size());
    for (Eigen::Index i = 0; i < u.size(); ++i)
      values.segment(i * v.size(), v.size()) = u(i) * v;
  }

private:
  static Eigen::VectorXd
  chebyshev(double x, Eigen::Index count)
  {
    Eigen::VectorXd values(count);
    values(0) = 1.0;
    values(1) = x;
    for (Eigen::Index k = 2; k < count; ++k)
      values(k) = 2.0 * x * values(k - 1) - values(k - 2);
    return values;
  }

  const CellPoints& points_;
  const Eigen::MatrixXd& u_;
  const Eigen::MatrixXd& v_;
};

/** Triangle of rows that are appended in blocks; the last column is the target. */
class RowTriangle {
public:
  explicit RowTriangle(Eigen::Index unknowns)
      : block_(std::max<Eigen::Index>(4 * unknowns, 64), unknowns + 1)
  {
  }

  Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>>
  append()
  {
    if (used_ == block_.rows())
      compress();
    return block_.row(used_++);
  }

  TriangularCell
  finish()
  {
    compress();
    TriangularCell cell;
    const Eigen::Index n = block_.cols() - 1;
    const Eigen::Index rank = std::min(used_, n);
    cell.R = block_.topLeftCorner(rank, n);
    cell.d = block_.col(n).head(rank);
    cell.rest.setConstant(1, used_ > n ? block_(n, n) * block_(n, n) : 0.0);
    return cell;
  }

private:
  void
  compress()
  {
    if (used_ <= block_.cols())
      return;
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(block_.topRows(used_));
    used_ = block_.cols();
    block_.topRows(used_) =
        qr.matrixQR().topRows(used_).triangularView<Eigen::Upper>().toDenseMatrix();
  }

  Eigen::MatrixXd block_;
  Eigen::Index used_ = 0;
};

TriangularCell
reduceCell(const CellPoints& points, const PlainRows& rows, int cell)
{
  const CellBasis basis(points, cell);
  const Eigen::Index channels = rows.factors.rows();
  RowTriangle triangle(basis.size() * channels);
  Eigen::VectorXd values;
  for (int at = points.begin[static_cast<std::size_t>(cell)];
       at < points.begin[static_cast<std::size_t>(cell) + 1];
       ++at) {
    basis.evaluate(static_cast<std::size_t>(at), values);
    const Eigen::Index point = points.order[static_cast<std::size_t>(at)];
    for (int r = 0; r < rows.per_point; ++r) {
      const Eigen::Index from = point * rows.per_point + r;
      auto row = triangle.append();
      for (Eigen::Index i = 0; i < values.size(); ++i)
        row.segment(i * channels, channels) =
            values(i) * rows.factors.col(from).transpose();
      row(values.size() * channels) = rows.targets(from);
    }
  }
  return triangle.finish();
}

} // namespace

std::vector<TriangularCell>
reduceRows(const CellPoints& points, const PlainRows& rows, int threads)
{
  std::vector<TriangularCell> cells(static_cast<std::size_t>(points.numCells()));
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) if (threads > 1)
  for (int cell = 0; cell < points.numCells(); ++cell)
    cells[static_cast<std::size_t>(cell)] = reduceCell(points, rows, cell);
  return cells;
}

TriangularCell
stackCells(const TriangularCell& first, const TriangularCell& second)
{
  const Eigen::Index unknowns = std::max(first.R.cols(), second.R.cols());
  RowTriangle triangle(unknowns);
  for (const TriangularCell* cell : {&first, &second})
    for (Eigen::Index k = 0; k < cell->R.rows(); ++k) {
      auto row = triangle.append();
      row.head(unknowns) = cell->R.row(k);
      row(unknowns) = cell->d(k, 0);
    }
  TriangularCell result = triangle.finish();
  result.rest = first.rest + second.rest;
  return result;
}

} // namespace nurbs
} // namespace pcl
