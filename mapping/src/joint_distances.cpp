// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "joint_distances.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

/** Row of a Tangent that is a pose's k-th degree of freedom. */
int
rowOf(int freedom, int k)
{
  return freedom == 3 ? kPlanarRows[static_cast<std::size_t>(k)] : k;
}

/** Whitened derivatives by the degrees of freedom of one end. */
Eigen::MatrixXd
whitened(const ProblemFactor& factor, const TangentMatrix& by_tangent, int freedom)
{
  const TangentMatrix all = factor.root * by_tangent;
  Eigen::MatrixXd result(factor.rows, freedom);
  for (int k = 0; k < freedom; ++k)
    result.col(k) = all.col(rowOf(freedom, k)).head(factor.rows);
  return result;
}

/** Rows of L^-1 B for a B with few rows: only those on the ways from B's rows to the root
 * of the elimination tree are not zero. */
class ForwardSolution {
public:
  explicit ForwardSolution(const Eigen::SparseMatrix<double>& lower)
      : lower_(lower), slots_(static_cast<std::size_t>(lower.cols()), -1)
  {
  }

  /** Rows that B has. */
  void
  reach(int row)
  {
    while (row >= 0 && slots_[static_cast<std::size_t>(row)] < 0) {
      slots_[static_cast<std::size_t>(row)] = 0;
      path_.push_back(row);
      Eigen::SparseMatrix<double>::InnerIterator entry(lower_, row);
      ++entry; // past the diagonal
      row = entry ? static_cast<int>(entry.row()) : -1;
    }
  }

  /** After all rows of B were named; they are then to be added. */
  void
  prepare()
  {
    std::sort(path_.begin(), path_.end());
    for (std::size_t k = 0; k < path_.size(); ++k)
      slots_[static_cast<std::size_t>(path_[k])] = static_cast<int>(k);
    rows_.setZero(6, static_cast<Eigen::Index>(path_.size()));
  }

  auto
  row(int index)
  {
    return rows_.col(slots_[static_cast<std::size_t>(index)]);
  }

  /** B^T (L L^T)^-1 B. */
  TangentMatrix
  squared()
  {
    for (std::size_t k = 0; k < path_.size(); ++k) {
      Eigen::SparseMatrix<double>::InnerIterator entry(lower_, path_[k]);
      auto solved = rows_.col(static_cast<Eigen::Index>(k));
      solved /= entry.value();
      for (++entry; entry; ++entry)
        row(static_cast<int>(entry.row())) -= entry.value() * solved;
    }
    return rows_ * rows_.transpose();
  }

private:
  const Eigen::SparseMatrix<double>& lower_;
  std::vector<int> slots_; // of each row among the path's, -1 for none
  std::vector<int> path_;
  Eigen::Matrix<double, 6, Eigen::Dynamic> rows_;
};

} // namespace

JointDistances::JointDistances(const PoseGraph& graph)
    : problem_(problemOf(graph, PoseGraphCost::Information))
{
  int next = 0;
  for (std::size_t k = 0; k < problem_.poses.size(); ++k) {
    const int freedom = problem_.freedom(static_cast<int>(k));
    columns_.push_back(freedom > 0 ? next : -1);
    next += freedom;
  }
  factorize();
}

void
JointDistances::factorize()
{
  std::vector<Eigen::Triplet<double>> entries;
  int size = 0;
  for (std::size_t k = 0; k < columns_.size(); ++k)
    size += problem_.freedom(static_cast<int>(k));
  const auto add = [&](int first, const Eigen::MatrixXd& a, int second, const Eigen::MatrixXd& b) {
    if (first < 0 || second < 0 || a.cols() == 0 || b.cols() == 0)
      return;
    const int row = columns_[static_cast<std::size_t>(first)];
    const int column = columns_[static_cast<std::size_t>(second)];
    const Eigen::MatrixXd block = a.transpose() * b;
    for (int r = 0; r < block.rows(); ++r)
      for (int c = 0; c < block.cols(); ++c)
        if (row + r >= column + c)
          entries.emplace_back(row + r, column + c, block(r, c));
  };
  for (const ProblemFactor& factor : problem_.factors) {
    ErrorValues values;
    linearizeError(factor.model,
                   problem_.pose(factor.first),
                   problem_.pose(factor.second),
                   values);
    const Eigen::MatrixXd first =
        whitened(factor, values.first, problem_.freedom(factor.first));
    const Eigen::MatrixXd second =
        whitened(factor, values.second, problem_.freedom(factor.second));
    add(factor.first, first, factor.first, first);
    add(factor.second, second, factor.second, second);
    add(factor.first, first, factor.second, second);
    add(factor.second, second, factor.first, first);
  }
  Sparse normal(size, size);
  normal.setFromTriplets(entries.begin(), entries.end());
  if (size == 0)
    return;
  cholesky_.compute(normal);
  if (cholesky_.info() != Eigen::Success)
    throw std::runtime_error("the factors do not determine all poses");
  lower_ = cholesky_.matrixL();
}

TangentMatrix
JointDistances::projected(const ProblemFactor& loop, const ErrorValues& values) const
{
  if (lower_.cols() == 0)
    return TangentMatrix::Zero();
  ForwardSolution solution(lower_);
  const auto eachRow = [&](int pose, const auto& use) {
    for (int k = 0; k < problem_.freedom(pose); ++k)
      use(cholesky_.permutationP().indices()(columns_[static_cast<std::size_t>(pose)] + k),
          k);
  };
  for (const int pose : {loop.first, loop.second})
    eachRow(pose, [&](int row, int) { solution.reach(row); });
  solution.prepare();
  const auto addEnd = [&](int pose, const TangentMatrix& by_tangent) {
    const Eigen::MatrixXd part = whitened(loop, by_tangent, problem_.freedom(pose));
    eachRow(pose, [&](int row, int k) { solution.row(row).head(loop.rows) += part.col(k); });
  };
  addEnd(loop.first, values.first);
  addEnd(loop.second, values.second);
  return solution.squared();
}

double
JointDistances::squaredDistance(const ProblemFactor& loop, bool in_graph) const
{
  ErrorValues values;
  linearizeError(
      loop.model, problem_.pose(loop.first), problem_.pose(loop.second), values);
  Tangent error = Tangent::Zero();
  error.head(loop.rows) = (loop.root * values.error).head(loop.rows);
  const TangentMatrix spread = projected(loop, values);
  const Eigen::SelfAdjointEigenSolver<TangentMatrix> parts(spread);
  const Tangent components = parts.eigenvectors().transpose() * error;
  constexpr double kDetermined = 1e-9; // share of the error that others see
  double sum = 0.0;
  for (Eigen::Index k = 0; k < 6; ++k) {
    const double share =
        in_graph ? 1.0 - parts.eigenvalues()(k) : 1.0 + parts.eigenvalues()(k);
    if (share > kDetermined)
      sum += components(k) * components(k) / share;
  }
  return sum;
}

std::vector<double>
JointDistances::squaredDistances(const std::vector<Query>& queries, int threads) const
{
  std::vector<double> distances(queries.size());
  const auto count = static_cast<std::ptrdiff_t>(queries.size());
#pragma omp parallel for num_threads(threads) schedule(dynamic, 16)
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const auto place = static_cast<std::size_t>(k);
    distances[place] = squaredDistance(*queries[place].loop, queries[place].in_graph);
  }
  return distances;
}

} // namespace nurbs
} // namespace pcl
