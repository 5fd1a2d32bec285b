// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {

/** \brief Where foot points may be in one direction: the domain widened by a margin. */
class FootRange {
public:
  FootRange(const KnotVector& knots, double margin)
      : length_(knots.domainLength()),
        low_(knots.domainMin() - margin * length_),
        high_(knots.domainMax() + margin * length_)
  {
  }

  double
  clamp(double u) const
  {
    return std::clamp(u, low_, high_);
  }

  /** \brief A step as a share of the domain. */
  double
  share(double step) const
  {
    return std::abs(step) / length_;
  }

private:
  double length_;
  double low_;
  double high_;
};

/** \brief Gauss-Newton steps towards the nearest surface point from a start close to
 * it; the cheap inner step of a fit. For a global answer use ClosestPointFinder.
 * \param[in] surface surface
 * \param[in] point point in space
 * \param[in] steps most steps taken
 * \param[in] margin how far the foot may leave the domain, relative to its length
 * \param[in] last_step share of the domain: a step below it is the last one and taken
 *            along the tangents, so that the point is off by its square
 * \param[in,out] uv start, then the foot point
 * \return point at the foot and derivatives there, or where the last step began */
inline SurfaceJet1
projectFrom(const NurbsSurface& surface,
            const Eigen::Vector3d& point,
            int steps,
            double margin,
            double last_step,
            Eigen::Ref<Eigen::Vector2d> uv)
{
  constexpr double kNegligible = 1e-14; // squared sine between the derivatives
  const FootRange range_u(surface.knotsU(), margin);
  const FootRange range_v(surface.knotsV(), margin);
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
    const Eigen::Vector2d next(range_u.clamp(uv.x() + (c * r - b * t) / determinant),
                               range_v.clamp(uv.y() + (a * t - b * r) / determinant));
    const double moved =
        std::max(range_u.share(next.x() - uv.x()), range_v.share(next.y() - uv.y()));
    const Eigen::Vector2d taken = next - uv;
    uv = next;
    if (moved < last_step) {
      jet.position += taken.x() * jet.du + taken.y() * jet.dv;
      break;
    }
    jet = surface.evaluateJet1(uv.x(), uv.y());
  }
  return jet;
}

} // namespace nurbs
} // namespace pcl
