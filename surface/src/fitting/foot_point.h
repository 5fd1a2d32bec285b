// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {

/** \brief The nearest parameter in the domain widened by \a margin times its length. */
inline double
clampNear(const KnotVector& knots, double margin, double u)
{
  const double extra = margin * knots.domainLength();
  return std::clamp(u, knots.domainMin() - extra, knots.domainMax() + extra);
}

/** \brief Gauss-Newton steps towards the nearest surface point from a start close to
 * it; the cheap inner step of a fit. For a global answer use ClosestPointFinder.
 * \param[in] surface surface
 * \param[in] point point in space
 * \param[in] steps most steps taken
 * \param[in] margin how far the foot may leave the domain, relative to its length
 * \param[in] last_step share of the domain: a step below it is the last one, as the
 *            distance is off by the square of what is left
 * \param[in,out] uv start, then the foot point
 * \return point and derivatives at the foot point */
inline SurfaceJet1
projectFrom(const NurbsSurface& surface,
            const Eigen::Vector3d& point,
            int steps,
            double margin,
            double last_step,
            Eigen::Ref<Eigen::Vector2d> uv)
{
  constexpr double kNegligible = 1e-14; // squared sine between the derivatives
  SurfaceJet1 jet = surface.evaluateJet1(uv.x(), uv.y());
  for (int step = 0; step < steps; ++step) {
    const Eigen::Vector3d offset = point - jet.position;
    const double a = jet.du.squaredNorm();
    const double b = jet.du.dot(jet.dv);
    const double c = jet.dv.squaredNorm();
    const double determinant = a * c - b * b;
    if (!(determinant > kNegligible * a * c))
      break;
    const double r = jet.du.dot(offset);
    const double t = jet.dv.dot(offset);
    const Eigen::Vector2d next(
        clampNear(surface.knotsU(), margin, uv.x() + (c * r - b * t) / determinant),
        clampNear(surface.knotsV(), margin, uv.y() + (a * t - b * r) / determinant));
    const double moved =
        std::max(std::abs(next.x() - uv.x()) / surface.knotsU().domainLength(),
                 std::abs(next.y() - uv.y()) / surface.knotsV().domainLength());
    uv = next;
    jet = surface.evaluateJet1(uv.x(), uv.y());
    if (moved < last_step)
      break;
  }
  return jet;
}

} // namespace nurbs
} // namespace pcl
