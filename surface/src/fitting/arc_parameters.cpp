// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "arc_parameters.h"

#include <pcl/surface/nurbs/conics.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kTurn = 6.283185307179586476925;

/** Smallest range that holds all angles: what is left of a turn beside the widest gap.
 */
AngleRange
occupiedRange(std::vector<double> angles)
{
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + kTurn - angles.back();
  AngleRange range{angles.front(), angles.back()};
  for (std::size_t k = 0; k + 1 < angles.size(); ++k)
    if (angles[k + 1] - angles[k] > widest) {
      widest = angles[k + 1] - angles[k];
      range = {angles[k + 1], angles[k] + kTurn};
    }
  return range;
}

/** Parameter of the arc at an angle. A quadratic segment of half sweep h is the square
 * of the chord between the unit vectors at half the angles of its ends, so t / (1 - t)
 * = sin(a / 2) / sin(h - a / 2) at the angle a from its begin. */
double
parameterAt(const std::vector<double>& joints, double angle)
{
  const auto next = std::upper_bound(joints.begin() + 1, joints.end() - 1, angle);
  const double begin = *(next - 1);
  const double sweep = *next - begin;
  const double rise = std::sin(0.5 * (angle - begin));
  const double fall = std::sin(0.5 * (*next - angle));
  return begin + sweep * rise / (rise + fall);
}

} // namespace

ArcPoints
arcParameters(const Eigen::Matrix3Xd& positions,
              const Eigen::Isometry3d& frame,
              bool closed)
{
  constexpr double kSmallestSweep = 1e-6;
  const Eigen::Matrix3Xd local =
      frame.linear().transpose() * (positions.colwise() - frame.translation());
  std::vector<double> angles;
  for (Eigen::Index k = 0; k < local.cols(); ++k)
    angles.push_back(std::atan2(local(1, k), local(0, k)));
  const AngleRange range =
      closed ? AngleRange{-0.5 * kTurn, 0.5 * kTurn} : occupiedRange(angles);
  if (!(range.sweep() > kSmallestSweep))
    throw std::domain_error("cylinder: the points are on one side of the axis");
  ArcPoints result;
  result.arc = circularArc(Eigen::Isometry3d::Identity(), 1.0, range);
  const std::vector<double> joints = result.arc.knots().breaks();
  result.parameters.resize(2, local.cols());
  result.radii = local.topRows(2).colwise().norm().transpose();
  for (Eigen::Index k = 0; k < local.cols(); ++k) {
    double angle = angles[static_cast<std::size_t>(k)];
    if (angle < range.first)
      angle += kTurn;
    angle = std::clamp(angle, range.first, range.last);
    result.parameters.col(k) << parameterAt(joints, angle), local(2, k);
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
