// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <limits>

namespace pcl {
namespace nurbs {
namespace {

/** a x b as a unit vector, or zero where it vanishes beside the size of its factors. */
Eigen::Vector3d
unitCross(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  constexpr double kParallel = 1e-10;
  const Eigen::Vector3d cross = a.cross(b);
  const double length = cross.norm();
  if (length > kParallel * a.norm() * b.norm() && length > 0.0)
    return cross / length;
  return Eigen::Vector3d::Zero();
}

/** Whether a derivative is no more than the rounding of the differences of control
 * points it was made from, so that its direction means nothing. */
bool
isRounding(const Eigen::Vector3d& derivative,
           const Eigen::Vector3d& position,
           const KnotVector& knots,
           double parameter)
{
  constexpr double kNoise = 32.0 * std::numeric_limits<double>::epsilon();
  const int span = knots.findSpan(parameter);
  const double length = knots[span + 1] - knots[span];
  return derivative.norm() * length <= kNoise * knots.degree() * position.norm();
}

/** +1 or -1: the sense of growing parameter that leads into the domain. */
double
inward(const KnotVector& knots, double parameter)
{
  return parameter < 0.5 * (knots.domainMin() + knots.domainMax()) ? 1.0 : -1.0;
}

/** Normal on a border that is a point, where S_u (or S_v) is zero: one step inside it
 * has the direction of S_uv, by its Taylor series. */
Eigen::Vector3d
poleNormal(const NurbsSurface& surface, double u, double v)
{
  const SurfaceJet2 jet = surface.evaluateJet2(u, v);
  const bool flat_u = isRounding(jet.du, jet.position, surface.knotsU(), u);
  const bool flat_v = isRounding(jet.dv, jet.position, surface.knotsV(), v);
  if (flat_u && !flat_v)
    return unitCross(inward(surface.knotsV(), v) * jet.duv, jet.dv);
  if (flat_v && !flat_u)
    return unitCross(jet.du, inward(surface.knotsU(), u) * jet.duv);
  return Eigen::Vector3d::Zero();
}

} // namespace

Eigen::Vector3d
NurbsSurface::normal(double u, double v) const
{
  const SurfaceJet1 jet = evaluateJet1(u, v);
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  if (!isRounding(jet.du, jet.position, knots_u_, u) &&
      !isRounding(jet.dv, jet.position, knots_v_, v))
    result = unitCross(jet.du, jet.dv);
  if (result.isZero())
    result = poleNormal(*this, u, v);
  // Both derivatives vanish, or they are parallel: walk towards the middle of the
  // domain until the direction is defined. The step is small enough that the normal is
  // its limit.
  const double mid_u = 0.5 * (knots_u_.domainMin() + knots_u_.domainMax());
  const double mid_v = 0.5 * (knots_v_.domainMin() + knots_v_.domainMax());
  for (double step = 1e-9; result.isZero() && step < 1e-3; step *= 10.0) {
    const SurfaceJet1 near =
        evaluateJet1(u + step * (mid_u - u), v + step * (mid_v - v));
    result = unitCross(near.du, near.dv);
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
