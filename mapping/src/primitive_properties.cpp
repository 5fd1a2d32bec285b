// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/primitives.h>
#include <pcl/surface/nurbs/primitives.h>

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

/** Box of a solid ellipsoid-like extent in a frame: half sizes along its axes. */
AlignedBox3d
boxAround(const Eigen::Isometry3d& frame, const Vector3d& low, const Vector3d& high)
{
  const Vector3d center = frame * (0.5 * (low + high));
  const Vector3d half = frame.linear().cwiseAbs() * (0.5 * (high - low));
  return {center - half, center + half};
}

AlignedBox3d
boundsOfPart(const PlanePatch& p)
{
  const Vector3d size(p.size_x, p.size_y, 0.0);
  if (p.outline == PlanePatch::Outline::Disc)
    return boxAround(p.frame, {-p.size_x, -p.size_x, 0.0}, {p.size_x, p.size_x, 0.0});
  return boxAround(p.frame, Vector3d::Zero(), size);
}

AlignedBox3d
boundsOfPart(const RuledPatch& p)
{
  AlignedBox3d box;
  for (const auto* border : {&p.start, &p.end})
    for (const Vector3d& point : *border)
      box.extend(point);
  return box;
}

AlignedBox3d
boundsOfPart(const FrustumPatch& p)
{
  const double r = std::max(p.radius_bottom, p.radius_top);
  return boxAround(p.frame, {-r, -r, 0.0}, {r, r, p.height});
}

AlignedBox3d
boundsOfPart(const SpherePatch& p)
{
  const double r = p.radius;
  return boxAround(p.frame,
                   {-r, -r, r * std::sin(p.latitude.first)},
                   {r, r, r * std::sin(p.latitude.last)});
}

AlignedBox3d
boundsOfPart(const TorusPatch& p)
{
  const double r = p.radius_major + p.radius_minor;
  return boxAround(p.frame, {-r, -r, -p.radius_minor}, {r, r, p.radius_minor});
}

Vector3d
normalOf(const PlanePatch& p, const Vector3d&)
{
  return p.frame.linear().col(2);
}

/** At the parameters of the nearest point, which Gauss-Newton finds. */
Vector3d
normalOf(const RuledPatch& p, const Vector3d& point)
{
  constexpr int kMostSteps = 20;
  constexpr double kLastStep = 1e-8; // the next one would be its square
  double u = 0.5;
  double v = 0.5;
  double step = 1.0;
  Vector3d du;
  Vector3d dv;
  for (int k = 0; k < kMostSteps && step > kLastStep; ++k) {
    const Vector3d start = p.point(0.0, v);
    const auto slope = [&](const std::array<Vector3d, 3>& c) {
      return Vector3d(2.0 * ((1.0 - v) * (c[1] - c[0]) + v * (c[2] - c[1])));
    };
    du = p.point(1.0, v) - start;
    dv = (1.0 - u) * slope(p.start) + u * slope(p.end);
    const Vector3d miss = point - start - u * du;
    const double uu = du.squaredNorm();
    const double uv = du.dot(dv);
    const double vv = dv.squaredNorm();
    const double determinant = uu * vv - uv * uv;
    const double by_u = du.dot(miss);
    const double by_v = dv.dot(miss);
    const double next_u =
        std::min(1.0, std::max(0.0, u + (vv * by_u - uv * by_v) / determinant));
    const double next_v =
        std::min(1.0, std::max(0.0, v + (uu * by_v - uv * by_u) / determinant));
    step = std::max(std::abs(next_u - u), std::abs(next_v - v));
    u = next_u;
    v = next_v;
  }
  return du.cross(dv).normalized();
}

Vector3d
normalOf(const FrustumPatch& p, const Vector3d& point)
{
  const Vector3d local = p.frame.inverse() * point;
  const double slope = (p.radius_top - p.radius_bottom) / p.height;
  const Vector3d outward(local.x(), local.y(), 0.0);
  return p.frame.linear() *
         (outward - slope * outward.norm() * Vector3d::UnitZ()).normalized();
}

Vector3d
normalOf(const SpherePatch& p, const Vector3d& point)
{
  return (point - p.frame.translation()).normalized();
}

Vector3d
normalOf(const TorusPatch& p, const Vector3d& point)
{
  const Vector3d local = p.frame.inverse() * point;
  const Vector3d ring =
      p.radius_major * Vector3d(local.x(), local.y(), 0.0).normalized();
  return p.frame.linear() * (local - ring).normalized();
}

NurbsSurface
nurbsOf(const PlanePatch& p)
{
  if (p.outline != PlanePatch::Outline::Disc)
    return planePatch(p.frame, p.size_x, p.size_y);
  Eigen::Isometry3d corner = p.frame;
  corner.translate(Vector3d(-p.size_x, -p.size_x, 0.0));
  return planePatch(corner, 2.0 * p.size_x, 2.0 * p.size_x);
}

NurbsSurface
nurbsOf(const RuledPatch& p)
{
  Eigen::Matrix3Xd points(3, 6);
  for (Eigen::Index k = 0; k < 3; ++k) {
    points.col(k) = p.start[static_cast<std::size_t>(k)];
    points.col(3 + k) = p.end[static_cast<std::size_t>(k)];
  }
  return NurbsSurface::fromControlPoints(
      KnotVector::bezier(1), KnotVector::bezier(2), points);
}

NurbsSurface
nurbsOf(const FrustumPatch& p)
{
  return frustum(p.frame, p.radius_bottom, p.radius_top, p.height, p.sweep);
}

NurbsSurface
nurbsOf(const SpherePatch& p)
{
  return sphere(p.frame, p.radius, {}, p.latitude);
}

NurbsSurface
nurbsOf(const TorusPatch& p)
{
  return torus(p.frame, p.radius_major, p.radius_minor, p.around);
}

template <typename Patch>
Patch
movedPart(Patch patch, const Eigen::Isometry3d& motion)
{
  patch.frame = motion * patch.frame;
  return patch;
}

RuledPatch
movedPart(RuledPatch patch, const Eigen::Isometry3d& motion)
{
  for (auto* border : {&patch.start, &patch.end})
    for (Vector3d& point : *border)
      point = motion * point;
  return patch;
}

} // namespace

Vector3d
normalAt(const Primitive& primitive, const Vector3d& point)
{
  return std::visit([&](const auto& part) { return normalOf(part, point); }, primitive);
}

AlignedBox3d
boundsOf(const Primitive& primitive)
{
  return std::visit([](const auto& part) { return boundsOfPart(part); }, primitive);
}

NurbsSurface
toNurbs(const Primitive& primitive)
{
  return std::visit([](const auto& part) { return nurbsOf(part); }, primitive);
}

Primitive
moved(const Primitive& primitive, const Eigen::Isometry3d& motion)
{
  return std::visit(
      [&](const auto& part) { return Primitive(movedPart(part, motion)); }, primitive);
}

} // namespace nurbs
} // namespace pcl
