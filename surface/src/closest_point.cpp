// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/closest_point.h>

#include "surface_descent.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Whether the iso-curves at both ends of the domain in \a direction are the same. */
bool
isClosed(const NurbsSurface& surface, Direction direction, double tolerance)
{
  const KnotVector& across = surface.knots(direction);
  const KnotVector& along =
      surface.knots(direction == Direction::U ? Direction::V : Direction::U);
  // Two rational curves of degree p that agree at 2 p + 1 parameters are the same.
  const std::vector<double> breaks = along.breaks();
  const int samples = 2 * along.degree();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int k = 0; k <= samples; ++k) {
      const double t = breaks[i] + (breaks[i + 1] - breaks[i]) * k / samples;
      const auto at = [&](double end) {
        return direction == Direction::U ? surface.evaluate(end, t)
                                         : surface.evaluate(t, end);
      };
      if ((at(across.domainMin()) - at(across.domainMax())).norm() > tolerance)
        return false;
    }
  return true;
}

} // namespace

struct ClosestPointFinder::Impl {
  explicit Impl(NurbsSurface s)
      : surface(std::move(s)),
        tree(extractBezier(surface)),
        intervals_u(surface.knotsU(),
                    isClosed(surface, Direction::U, 1e-10 * tree.size())),
        intervals_v(surface.knotsV(),
                    isClosed(surface, Direction::V, 1e-10 * tree.size()))
  {
  }

  SurfaceDescent
  descend(const Eigen::Vector3d& point, double u, double v) const
  {
    SurfaceDescent descent(
        surface, intervals_u, intervals_v, tree.size(), point, {u, v});
    descent.run();
    return descent;
  }

  NurbsSurface surface;
  PatchTree tree;
  SmoothIntervals intervals_u;
  SmoothIntervals intervals_v;
};

ClosestPointFinder::ClosestPointFinder(NurbsSurface surface)
    : impl_(std::make_shared<const Impl>(std::move(surface)))
{
}

const NurbsSurface&
ClosestPointFinder::surface() const
{
  return impl_->surface;
}

ClosestPoint
ClosestPointFinder::find(const Eigen::Vector3d& point) const
{
  if (!point.allFinite())
    throw std::invalid_argument("ClosestPointFinder: the point is not finite");
  DistanceSearch search(impl_->tree, point, [this, &point](double u, double v) {
    return impl_->descend(point, u, v).foot();
  });
  const FootPoint best = search.run();
  return impl_->descend(point, best.u, best.v).result();
}

ClosestPoint
ClosestPointFinder::findFrom(const Eigen::Vector3d& point, double u, double v) const
{
  if (!point.allFinite() || !std::isfinite(u) || !std::isfinite(v))
    throw std::invalid_argument(
        "ClosestPointFinder: the point or the start is not finite");
  return impl_->descend(point, u, v).result();
}

std::optional<Eigen::Vector2d>
ClosestPointFinder::invert(const Eigen::Vector3d& point, double tolerance) const
{
  const ClosestPoint closest = find(point);
  if (!(closest.distance <= tolerance))
    return std::nullopt;
  return Eigen::Vector2d(closest.u, closest.v);
}

} // namespace nurbs
} // namespace pcl
