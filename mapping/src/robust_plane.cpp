// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "robust_plane.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <random>

namespace pcl {
namespace nurbs {
namespace {

using Plane = Eigen::Hyperplane<double, 3>;

constexpr Eigen::Index kSample = 1000; // points that vote
constexpr int kTrials = 300;           // finds planes with a fifth of the points
constexpr int kRefinements = 3;

/** Every so-manieth column, about kSample of them. */
Eigen::Matrix3Xd
thinned(const Eigen::Matrix3Xd& positions)
{
  const Eigen::Index stride = positions.cols() / kSample + 1;
  Eigen::Matrix3Xd result(3, (positions.cols() + stride - 1) / stride);
  for (Eigen::Index k = 0; k < result.cols(); ++k)
    result.col(k) = positions.col(k * stride);
  return result;
}

/** Sum of squared distances, each cut off at the reach. */
double
cost(const Plane& plane, const Eigen::Matrix3Xd& points, double reach)
{
  const auto distances = (plane.normal().transpose() * points).array() + plane.offset();
  return distances.square().min(reach * reach).sum();
}

/** Plane of the principal axes of the points within reach; the same plane when they are
 * too few. */
Plane
refined(const Plane& plane, const Eigen::Matrix3Xd& points, double reach)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  const Eigen::Vector3d origin = points.col(0);
  double count = 0.0;
  for (Eigen::Index k = 0; k < points.cols(); ++k)
    if (plane.absDistance(points.col(k)) <= reach) {
      const Eigen::Vector3d offset = points.col(k) - origin;
      sum += offset;
      products += offset * offset.transpose();
      ++count;
    }
  if (count < 3.0)
    return plane;
  const Eigen::Matrix3d scatter = products - sum * sum.transpose() / count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  return {solver.eigenvectors().col(0), origin + sum / count};
}

} // namespace

Slab
robustSlab(const Eigen::Matrix3Xd& positions, double reach)
{
  const Eigen::Matrix3Xd points = thinned(positions);
  std::mt19937 random(1);
  const auto draw = [&] {
    // The library's distributions differ between implementations.
    return points.col(
        static_cast<Eigen::Index>(random() % static_cast<unsigned>(points.cols())));
  };
  Plane best(Eigen::Vector3d::UnitZ(), points.col(0));
  double least = cost(best, points, reach);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Vector3d corner = draw();
    const Eigen::Vector3d normal =
        (draw() - corner).cross(draw() - corner).normalized();
    if (!(normal.squaredNorm() > 0.5))
      continue; // three points on a line
    const Plane plane(normal, corner);
    const double value = cost(plane, points, reach);
    if (value < least) {
      least = value;
      best = plane;
    }
  }
  for (int round = 0; round < kRefinements; ++round)
    best = refined(best, positions, reach);
  return {best, reach};
}

} // namespace nurbs
} // namespace pcl
