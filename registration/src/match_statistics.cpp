// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "match_statistics.h"

#include "chunked_sum.h"
#include "gradient_scatter.h"
#include "gradient_slope.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** Cells of the gradient's scatter, in voxels: a plane is of two, and points within
 * one share it. */
constexpr double kCellVoxels = 2.0;

struct DescriptionSums {
  TangentMatrix support = TangentMatrix::Zero();
  double squared_range = 0.0;
  double weight = 0.0;
  double weighted_square = 0.0;
  double count = 0.0;
  double inliers = 0.0;
  double near = 0.0;

  void
  operator+=(const DescriptionSums& other)
  {
    support += other.support;
    squared_range += other.squared_range;
    weight += other.weight;
    weighted_square += other.weighted_square;
    count += other.count;
    inliers += other.inliers;
    near += other.near;
  }
};

/** Whether a pair's point lies on the target: near its plane, or near its points where
 * there is none. */
bool
isInlier(const MatchPair& pair, const PairTerm& term, double voxel_size)
{
  constexpr double kNearPlane = 0.2;
  constexpr double kNearPoints = 0.4;
  if (pair.surface.flat())
    return term.square <= std::pow(kNearPlane * voxel_size, 2) &&
           (pair.place - pair.target).squaredNorm() <= voxel_size * voxel_size;
  return term.residual.squaredNorm() <= std::pow(kNearPoints * voxel_size, 2);
}

/** Rows and columns of rotations divided by a length. */
TangentMatrix
scaled(TangentMatrix matrix, double scale)
{
  matrix.rightCols<3>() /= scale;
  matrix.bottomRows<3>() /= scale;
  return matrix;
}

Degeneracy
degeneracyOf(const DescriptionSums& sums, double min_support)
{
  Degeneracy result;
  result.scale = std::sqrt(sums.squared_range / sums.count);
  const Eigen::SelfAdjointEigenSolver<TangentMatrix> solver(
      scaled(sums.support / sums.count, result.scale));
  result.directions = solver.eigenvectors();
  result.support = solver.eigenvalues().cwiseMax(0.0);
  result.unsupported = static_cast<int>((result.support.array() < min_support).count());
  return result;
}

/** Covariance and information from the gradient's slope and scatter, in the directions
 * that the surroundings support. */
void
setUncertainty(const TangentMatrix& slope,
               const GradientScatter& scatter,
               MatchResult& result)
{
  const Degeneracy& degeneracy = result.degeneracy;
  const int known = 6 - degeneracy.unsupported;
  Eigen::MatrixXd back = degeneracy.directions; // to tangents in metres and radians
  back.bottomRows<3>() /= degeneracy.scale;
  const Eigen::MatrixXd basis = back.rightCols(known);
  const Eigen::MatrixXd inverse = (basis.transpose() * slope * basis).inverse();
  const Eigen::MatrixXd within = scatter.in(basis);
  const Eigen::MatrixXd reduced = inverse * within * inverse;
  const Eigen::MatrixXd unknown = back.leftCols(degeneracy.unsupported);
  result.covariance = basis * reduced * basis.transpose() +
                      kUnsupportedVariance * unknown * unknown.transpose();
  Eigen::MatrixXd dual = degeneracy.directions.rightCols(known);
  dual.bottomRows<3>() *= degeneracy.scale;
  result.information = dual * reduced.inverse() * dual.transpose();
}

} // namespace

Eigen::Matrix<double, 3, 6>
pointJacobian(const Eigen::Vector3f& point)
{
  const Eigen::Vector3d p = point.cast<double>();
  Eigen::Matrix<double, 3, 6> jacobian;
  jacobian << 1.0, 0.0, 0.0, 0.0, p.z(), -p.y(), //
      0.0, 1.0, 0.0, -p.z(), 0.0, p.x(),         //
      0.0, 0.0, 1.0, p.y(), -p.x(), 0.0;
  return jacobian;
}

TangentMatrix
normalNoise(const Eigen::Matrix<double, 3, 6>& jacobian,
            const Eigen::Matrix3d& rotation,
            const LocalSurface& surface)
{
  return jacobian.transpose() *
         (rotation.transpose() * surface.normal_covariance * rotation) * jacobian;
}

void
describeMatch(const MatchPairs& pairs,
              const ScanPoints& scan,
              const RobustKernel& kernel,
              const MatchOptions& options,
              double voxel_size,
              MatchResult& result)
{
  const auto add = [&](std::size_t i, DescriptionSums& sums) {
    const MatchPair& pair = pairs.pairs()[i];
    if (!pair.found)
      return;
    const PairTerm& term = pairs.term(i);
    const Eigen::Matrix<double, 3, 6> jacobian = pointJacobian(scan[i]);
    const Eigen::Vector3d normal =
        result.pose.linear().transpose() * pair.surface.normal;
    if (pair.surface.flat()) {
      const Tangent row = jacobian.transpose() * normal;
      sums.support += row * row.transpose() -
                      normalNoise(jacobian, result.pose.linear(), pair.surface);
    }
    else if (pair.surface.scattered) {
      const Eigen::Matrix3d& turn = result.pose.linear();
      sums.support += options.scatter_weight * jacobian.transpose() *
                      (turn.transpose() * pair.surface.held * turn) * jacobian;
    }
    const double weight = kernel.weight(term.square);
    sums.squared_range += scan[i].cast<double>().squaredNorm();
    sums.weight += weight;
    sums.weighted_square += weight * term.square;
    sums.count += 1.0;
    sums.near +=
        (pair.place - pair.target).squaredNorm() <= voxel_size * voxel_size ? 1.0 : 0.0;
    sums.inliers += isInlier(pair, term, voxel_size) ? 1.0 : 0.0;
  };
  const auto sums = chunkedSum<DescriptionSums>(scan.size(), options.threads, add);
  result.correspondences = static_cast<std::size_t>(sums.count);
  result.inlier_share = sums.inliers / static_cast<double>(scan.size());
  result.near_share = sums.near / static_cast<double>(scan.size());
  result.rmse = std::sqrt(sums.weighted_square / sums.weight);
  result.degeneracy = degeneracyOf(sums, options.min_support);
  setUncertainty(gradientSlope(pairs, scan, result.pose, kernel, options, voxel_size),
                 GradientScatter(pairs, scan, kernel, kCellVoxels * voxel_size),
                 result);
}

} // namespace nurbs
} // namespace pcl
