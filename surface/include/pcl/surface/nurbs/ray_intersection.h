// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief The points origin + t direction, t_min <= t <= t_max. The direction need not
 * be a unit vector. */
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  double t_min = 0.0;
  double t_max = std::numeric_limits<double>::infinity();

  /** \brief The segment from \a from (t = 0) to \a to (t = 1). */
  static Ray
  segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
  {
    return {from, to - from, 0.0, 1.0};
  }
};

/** \brief A common point of a ray and a surface. */
struct RayHit {
  double t = 0.0;
  double u = 0.0;
  double v = 0.0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(); /**< \brief S(u, v) */
  bool tangential =
      false; /**< \brief The ray touches the surface here (angle between
                ray and tangent plane below 1e-6), or there is no normal. */
};

/** \brief Intersects rays with a surface.
 *
 * Construction costs what that of ClosestPointFinder does. In ray coordinates the
 * surface is a Bézier piece whose first two components vanish where the ray meets it:
 * pieces whose control points lie on one side are dropped, pieces on which the
 * components are provably one-to-one are solved by Newton's method, others are halved.
 * Queries are const and may run from many threads; copies share the prepared data.
 * \ingroup surface
 */
class PCL_NURBS_SURFACE_EXPORT RayIntersector {
public:
  explicit RayIntersector(NurbsSurface surface);

  const NurbsSurface&
  surface() const;

  /** \brief All common points in the order of t.
   *
   * A common point is reported once, also on a seam, at a pole or where the surface
   * crosses itself; two that are closer than 1e-9 times the size of the surface (1e-6
   * if tangential) count as one. Surfaces as near as 1e-10 of their size count as
   * touched. A stretch of the ray within the surface gives a dense sequence of
   * tangential hits. \throws std::invalid_argument if the ray is not finite, the
   * direction is zero or the range of t is empty or NaN */
  std::vector<RayHit>
  intersect(const Ray& ray) const;

  /** \brief The common point of smallest t, or nothing. Same conditions, faster. */
  std::optional<RayHit>
  nearest(const Ray& ray) const;

private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

} // namespace nurbs
} // namespace pcl
