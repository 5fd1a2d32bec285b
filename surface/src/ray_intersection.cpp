// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/ray_intersection.h>

#include "ray_search.h"

#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

void
requireValid(const Ray& ray)
{
  if (!ray.origin.allFinite() || !ray.direction.allFinite())
    throw std::invalid_argument("Ray: origin or direction is not finite");
  if (!(ray.direction.squaredNorm() > 0.0))
    throw std::invalid_argument("Ray: the direction is zero");
  if (!(ray.t_min <= ray.t_max))
    throw std::invalid_argument("Ray: the range of t is empty");
}

} // namespace

struct RayIntersector::Impl {
  explicit Impl(NurbsSurface s) : surface(std::move(s)), tree(extractBezier(surface)) {}

  std::vector<RayHit>
  search(const Ray& ray, bool nearest_only) const
  {
    requireValid(ray);
    return RaySearch(surface, tree, ray, nearest_only).run();
  }

  NurbsSurface surface;
  PatchTree tree;
};

RayIntersector::RayIntersector(NurbsSurface surface)
    : impl_(std::make_shared<const Impl>(std::move(surface)))
{
}

const NurbsSurface&
RayIntersector::surface() const
{
  return impl_->surface;
}

std::vector<RayHit>
RayIntersector::intersect(const Ray& ray) const
{
  return impl_->search(ray, false);
}

std::optional<RayHit>
RayIntersector::nearest(const Ray& ray) const
{
  const std::vector<RayHit> hits = impl_->search(ray, true);
  if (hits.empty())
    return std::nullopt;
  return hits.front();
}

} // namespace nurbs
} // namespace pcl
