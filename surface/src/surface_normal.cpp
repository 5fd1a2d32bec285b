// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/nurbs_surface.h>

#include "regular_point.h"

namespace pcl {
namespace nurbs {
namespace {

Eigen::Vector3d
unitNormalAt(const NurbsSurface& surface, double u, double v)
{
  const SurfaceJet1 jet = surface.evaluateJet1(u, v);
  return unitNormal(surface, jet.du, jet.dv);
}

} // namespace

Eigen::Vector3d
NurbsSurface::normal(double u, double v) const
{
  Eigen::Vector3d result = unitNormalAt(*this, u, v);
  // At a pole one derivative is zero: walk towards the middle of the domain until the
  // direction is defined. The step is small enough that the normal is its limit.
  const double mid_u = 0.5 * (knots_u_.domainMin() + knots_u_.domainMax());
  const double mid_v = 0.5 * (knots_v_.domainMin() + knots_v_.domainMax());
  for (double step = 1e-8; result.isZero() && step < 1e-3; step *= 10.0)
    result = unitNormalAt(*this, u + step * (mid_u - u), v + step * (mid_v - v));
  return result;
}

} // namespace nurbs
} // namespace pcl
