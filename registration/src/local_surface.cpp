// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "local_surface.h"

#include <Eigen/Eigenvalues>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kMinPoints = 6.0;
/** Of the variance, at most so much across the plane ... */
constexpr double kMaxThickness = 0.03;
/** ... and at least so much across the longest extent: one ring is no plane. */
constexpr double kMinWidth = 0.03;
/** An edge of two planes has 0.08 of its variance across, a ball a third. */
constexpr double kMinScatter = 0.12;

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
  const double total = variance.sum();
  if (variance[0] <= kMaxThickness * total && variance[1] >= kMinWidth * total)
    surface.normal = solver.eigenvectors().col(0);
  surface.scattered = variance[0] >= kMinScatter * total;
  return surface;
}

} // namespace nurbs
} // namespace pcl
