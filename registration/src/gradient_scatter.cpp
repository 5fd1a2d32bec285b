// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "gradient_scatter.h"

#include "match_statistics.h"
#include "voxel_key.h"

#include <Eigen/Dense>

#include <cmath>
#include <unordered_map>

namespace pcl {
namespace nurbs {

GradientScatter::GradientScatter(const MatchPairs& pairs,
                                 const ScanPoints& scan,
                                 const RobustKernel& kernel,
                                 double cell_size)
{
  std::unordered_map<std::uint64_t, std::size_t> known;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const MatchPair& pair = pairs.pairs()[i];
    const auto place = voxelCell(pair.target, 1.0 / cell_size);
    if (!pair.found || !place)
      continue;
    const auto at = known.emplace(voxelKey(*place), cells_.size());
    if (at.second)
      cells_.push_back({*place});
    const PairTerm& term = pairs.term(i);
    const Eigen::Matrix<double, 3, 6> jacobian = pointJacobian(scan[i]);
    const Eigen::Matrix<double, 6, 3> weighted =
        kernel.weight(term.square) * jacobian.transpose() * term.metric;
    Cell& cell = cells_[at.first->second];
    cell.gradient += weighted * term.residual;
    cell.weight += weighted * jacobian;
  }
  for (std::size_t i = 0; i < cells_.size(); ++i)
    for (int k = 13; k < 27; ++k) { // itself, and one of each two opposite ones
      const Eigen::Vector3i step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      const auto at = known.find(voxelKey(cells_[i].place + step));
      if (at != known.end())
        neighbours_.push_back({i, at->second, std::pow(0.5, step.cwiseAbs().sum())});
    }
}

double
GradientScatter::effectiveCount(const Eigen::MatrixXd& basis) const
{
  TangentMatrix whole = TangentMatrix::Zero();
  for (const Cell& cell : cells_)
    whole += cell.weight;
  const Eigen::MatrixXd inverse = (basis.transpose() * whole * basis).inverse();
  std::vector<double> shares; // of what holds the pose
  for (const Cell& cell : cells_)
    shares.push_back((inverse * (basis.transpose() * cell.weight * basis)).trace());
  double squares = 0.0;
  for (const Neighbours& both : neighbours_)
    squares += (both.first == both.second ? 1.0 : 2.0) * both.weight * both.weight *
               shares[both.first] * shares[both.second];
  return std::pow(static_cast<double>(basis.cols()), 2) / squares;
}

Eigen::MatrixXd
GradientScatter::in(const Eigen::MatrixXd& basis) const
{
  TangentMatrix scatter = TangentMatrix::Zero();
  for (const Neighbours& both : neighbours_) {
    const TangentMatrix product = both.weight * cells_[both.first].gradient *
                                  cells_[both.second].gradient.transpose();
    scatter += product;
    if (both.first != both.second)
      scatter += product.transpose();
  }
  // Parameters were fitted to the gradients' sum, and the mean of the inverse of an
  // estimated scatter is too large (Hotelling): both count with few cells only.
  const double count = effectiveCount(basis);
  const auto fitted = static_cast<double>(basis.cols());
  const double correction = count / std::max(count - fitted, 1.0) * (count - 1.0) /
                            std::max(count - fitted - 2.0, 1.0);
  return correction * basis.transpose() * scatter * basis;
}

} // namespace nurbs
} // namespace pcl
