// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "town_parts.h"

namespace pcl {
namespace nurbs {

using Eigen::Vector3d;

namespace {

PlanePatch
planeAlong(const Vector3d& corner, const Vector3d& along_x, const Vector3d& along_y)
{
  PlanePatch patch;
  patch.size_x = along_x.norm();
  patch.size_y = along_y.norm();
  const Vector3d x = along_x / patch.size_x;
  const Vector3d y = (along_y - x.dot(along_y) * x).normalized();
  patch.frame.linear() << x, y, x.cross(y);
  patch.frame.translation() = corner;
  return patch;
}

} // namespace

Eigen::Isometry3d
uprightFrame(const Vector3d& place, const Eigen::Vector2d& x_axis)
{
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << x_axis.x(), -x_axis.y(), 0.0, x_axis.y(), x_axis.x(), 0.0, 0.0, 0.0,
      1.0;
  frame.translation() = place;
  return frame;
}

void
TownParts::add(const Primitive& primitive)
{
  primitives.push_back(moved(primitive, frame_));
  surfaces.push_back({kind_, reflectivity_, object_});
}

void
TownParts::addRectangle(const Vector3d& corner,
                        const Vector3d& along_x,
                        const Vector3d& along_y,
                        const OpeningGrid& openings)
{
  PlanePatch patch = planeAlong(corner, along_x, along_y);
  patch.openings = openings;
  add(patch);
}

void
TownParts::addGable(const Vector3d& corner,
                    const Vector3d& along_x,
                    const Vector3d& along_y)
{
  PlanePatch patch = planeAlong(corner, along_x, along_y);
  patch.outline = PlanePatch::Outline::Gable;
  add(patch);
}

void
TownParts::addBox(const Vector3d& low, const Vector3d& high)
{
  const Vector3d size = high - low;
  const Vector3d x(size.x(), 0.0, 0.0);
  const Vector3d y(0.0, size.y(), 0.0);
  const Vector3d z(0.0, 0.0, size.z());
  addRectangle(low, x, z);
  addRectangle(low + y, x, z);
  addRectangle(low, y, z);
  addRectangle(low + x, y, z);
  addRectangle(low + z, x, y);
}

void
TownParts::addCylinder(const Vector3d& foot,
                       const Vector3d& axis,
                       double radius,
                       double radius_top,
                       const AngleRange& sweep)
{
  FrustumPatch patch;
  patch.frame = frameFromAxis(foot, axis);
  patch.radius_bottom = radius;
  patch.radius_top = radius_top;
  patch.height = axis.norm();
  patch.sweep = sweep;
  add(patch);
}

void
TownParts::addDisc(const Vector3d& center, const Vector3d& normal, double radius)
{
  PlanePatch patch;
  patch.frame = frameFromAxis(center, normal);
  patch.outline = PlanePatch::Outline::Disc;
  patch.size_x = patch.size_y = radius;
  add(patch);
}

void
TownParts::addDome(const Vector3d& center, double radius)
{
  SpherePatch patch;
  patch.frame.translation() = center;
  patch.radius = radius;
  patch.latitude.first = 0.0;
  add(patch);
}

void
TownParts::addSphere(const Vector3d& center, double radius)
{
  SpherePatch patch;
  patch.frame.translation() = center;
  patch.radius = radius;
  add(patch);
}

} // namespace nurbs
} // namespace pcl
