// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <algorithm>

namespace pcl {
namespace nurbs {
namespace {

/** S_u x S_v as a unit vector, or zero where it vanishes beside the size of its
 * factors. */
Eigen::Vector3d
unitCross(const SurfaceJet1& jet)
{
  constexpr double kParallel = 1e-10;
  const Eigen::Vector3d cross = jet.du.cross(jet.dv);
  const double length = cross.norm();
  if (length > kParallel * jet.du.norm() * jet.dv.norm() && length > 0.0)
    return cross / length;
  return Eigen::Vector3d::Zero();
}

} // namespace

Eigen::Vector3d
NurbsSurface::normal(double u, double v) const
{
  Eigen::Vector3d result = unitCross(evaluateJet1(u, v));
  // At a pole one derivative is zero: walk towards the middle of the domain until the
  // direction is defined. The step is small enough that the normal is its limit.
  const double mid_u = 0.5 * (knots_u_.domainMin() + knots_u_.domainMax());
  const double mid_v = 0.5 * (knots_v_.domainMin() + knots_v_.domainMax());
  for (double step = 1e-9; result.isZero() && step < 1e-3; step *= 10.0)
    result = unitCross(evaluateJet1(u + step * (mid_u - u), v + step * (mid_v - v)));
  return result;
}

} // namespace nurbs
} // namespace pcl
