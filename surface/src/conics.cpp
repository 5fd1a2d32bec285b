// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/conics.h>

#include "argument_checks.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kPi = 3.141592653589793238463;
// Angles that come out of a sum or a multiple of pi are off by a few roundings.
constexpr double kAngleRounding = 1e-14;

/** (cos, sin), exactly 0 and 1 at the quarter turns so that poles and closed ends have
 * no rounding error. */
Eigen::Vector2d
unitVector(double angle)
{
  const double quarter = std::round(angle / (0.5 * kPi));
  if (std::abs(angle - quarter * 0.5 * kPi) > kAngleRounding)
    return {std::cos(angle), std::sin(angle)};
  static const Eigen::Vector2d axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  return axes[((static_cast<long>(quarter) % 4) + 4) % 4];
}

void
requireRange(const AngleRange& range)
{
  const bool finite = std::isfinite(range.first) && std::isfinite(range.last);
  if (!finite || !(range.sweep() > 0.0) || range.sweep() > 2.0 * kPi + kAngleRounding)
    throw std::invalid_argument("the sweep of an arc must be in (0, 2 pi]");
}

/** Knots of degree 2 on the range: inner knots double, one segment per quarter. */
KnotVector
arcKnots(const AngleRange& range, int segments)
{
  std::vector<double> knots(3, range.first);
  for (int i = 1; i < segments; ++i)
    knots.insert(knots.end(), 2, range.first + range.sweep() * i / segments);
  knots.insert(knots.end(), 3, range.last);
  return {2, std::move(knots)};
}

/** Arc of the unit circle about the origin (A7.1): control points lie on the circle at
 * the joints and on the intersection of the tangents between them. */
NurbsCurve2
unitArc(const AngleRange& range)
{
  requireRange(range);
  const int segments = std::max(
      1, static_cast<int>(std::ceil(range.sweep() / (0.5 * kPi) - kAngleRounding)));
  const double half = 0.5 * range.sweep() / segments;
  NurbsCurve2::HomogeneousPoints points(3, 2 * segments + 1);
  for (int i = 0; i <= 2 * segments; ++i) {
    const double angle = i == 2 * segments ? range.last : range.first + i * half;
    // w P of a middle point: P = unit / cos(half), w = cos(half).
    points.col(i) << unitVector(angle), i % 2 == 0 ? 1.0 : std::cos(half);
  }
  if (std::abs(range.sweep() - 2.0 * kPi) <= kAngleRounding)
    points.col(2 * segments) = points.col(0);
  return {arcKnots(range, segments), std::move(points)};
}

} // namespace

Eigen::Isometry3d
frameFromAxis(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis)
{
  const double length = axis.stableNorm();
  if (!origin.allFinite() || !std::isfinite(length) || !(length > 0.0))
    throw std::invalid_argument("frameFromAxis: the axis needs a direction");
  const Eigen::Vector3d z = (axis / length).normalized();
  const Eigen::Vector3d x = z.unitOrthogonal();
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << x, z.cross(x), z;
  frame.translation() = origin;
  return frame;
}

NurbsCurve2
ellipticArc(const Eigen::Isometry2d& frame,
            double radius_x,
            double radius_y,
            const AngleRange& range)
{
  requirePositive(radius_x, "radius");
  requirePositive(radius_y, "radius");
  requireRigid(frame);
  return unitArc(range).transformed(frame * Eigen::Scaling(radius_x, radius_y));
}

NurbsCurve3
ellipticArc(const Eigen::Isometry3d& frame,
            double radius_x,
            double radius_y,
            const AngleRange& range)
{
  requireRigid(frame);
  const NurbsCurve2 flat =
      ellipticArc(Eigen::Isometry2d::Identity(), radius_x, radius_y, range);
  NurbsCurve3::HomogeneousPoints points =
      NurbsCurve3::HomogeneousPoints::Zero(4, flat.numControlPoints());
  points.topRows<2>() = flat.homogeneousPoints().topRows<2>();
  points.row(3) = flat.homogeneousPoints().row(2);
  return NurbsCurve3(flat.knots(), std::move(points)).transformed(frame);
}

NurbsCurve2
circularArc(const Eigen::Isometry2d& frame, double radius, const AngleRange& range)
{
  return ellipticArc(frame, radius, radius, range);
}

NurbsCurve3
circularArc(const Eigen::Isometry3d& frame, double radius, const AngleRange& range)
{
  return ellipticArc(frame, radius, radius, range);
}

} // namespace nurbs
} // namespace pcl
