// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "local_surface.h"

#include <Eigen/Eigenvalues>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kMinPoints = 6.0;
/** Points within a micrometre are one point many times over. */
constexpr double kMinVariance = 1e-12; // metres squared
/** Of the variance, at most so much across the plane ... */
constexpr double kMaxThickness = 0.03;
/** ... and at least so much across the longest extent: one ring is no plane. */
constexpr double kMinWidth = 0.03;
/** An edge of two planes has about 0.14 of its variance across, a ball a third. */
constexpr double kMinScatter = 0.2;
/** A few points on such an edge may look like a ball. */
constexpr double kMinScatterPoints = 20.0;

/** Of the eigenvector to the smallest of three variances of so many points
 * (Anderson, Asymptotic theory for principal component analysis, 1963, eq. 2.18). */
Eigen::Matrix3d
normalCovariance(double count,
                 const Eigen::Vector3d& variance,
                 const Eigen::Matrix3d& axes)
{
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  const double noise = variance[0] / (count - 3.0); // a plane has three parameters
  for (int k = 1; k < 3; ++k) {
    const double gap = variance[k] - variance[0];
    covariance +=
        noise * variance[k] / (gap * gap) * axes.col(k) * axes.col(k).transpose();
  }
  return covariance;
}

} // namespace

LocalSurface
localSurface(const PointMoments& moments)
{
  LocalSurface surface;
  surface.mean = moments.mean;
  if (moments.count < kMinPoints)
    return surface;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(moments.covariance);
  const Eigen::Vector3d variance = solver.eigenvalues();
  const Eigen::Matrix3d axes = solver.eigenvectors();
  const double total = variance.sum();
  if (!(total > kMinVariance))
    return surface;
  surface.scattered =
      moments.count >= kMinScatterPoints && variance[0] >= kMinScatter * total;
  if (variance[0] <= kMaxThickness * total && variance[1] >= kMinWidth * total) {
    surface.normal = axes.col(0);
    surface.normal_covariance = normalCovariance(moments.count, variance, axes);
  }
  else if (!surface.scattered) {
    surface.line = axes.col(2);
  }
  return surface;
}

} // namespace nurbs
} // namespace pcl
