// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/primitives.h>

#include <pcl/surface/nurbs/constructions.h>

#include "argument_checks.h"

#include <algorithm>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Revolve a profile given in the (radius, height) half-plane about the z axis. */
NurbsSurface
revolveProfile(const Eigen::Isometry3d& frame,
               const NurbsCurve2& profile,
               const AngleRange& sweep)
{
  requireRigid(frame);
  NurbsCurve3::HomogeneousPoints points =
      NurbsCurve3::HomogeneousPoints::Zero(4, profile.numControlPoints());
  points.row(0) = profile.homogeneousPoints().row(0);
  points.bottomRows<2>() = profile.homogeneousPoints().bottomRows<2>();
  // Revolving before placing keeps a pole, radius 0, free of rounding.
  return revolvedSurface(NurbsCurve3(profile.knots(), std::move(points)),
                         Eigen::Isometry3d::Identity(),
                         sweep)
      .transformed(frame);
}

void
requireLatitudes(const AngleRange& range)
{
  constexpr double kSlack = 1e-12;
  if (!(range.first >= kAllLatitudes.first - kSlack) ||
      !(range.last <= kAllLatitudes.last + kSlack))
    throw std::invalid_argument("sphere: a latitude is outside of [-pi/2, pi/2]");
}

/** Smallest cosine over a range of angles. */
double
minimumCosine(const AngleRange& range)
{
  const double pi = 2.0 * kAllLatitudes.last;
  const double next_minimum =
      pi + 2.0 * pi * std::ceil((range.first - pi) / (2.0 * pi));
  if (next_minimum <= range.last)
    return -1.0;
  return std::min(std::cos(range.first), std::cos(range.last));
}

} // namespace

NurbsSurface
bilinearPatch(const Eigen::Vector3d& corner_00,
              const Eigen::Vector3d& corner_10,
              const Eigen::Vector3d& corner_01,
              const Eigen::Vector3d& corner_11)
{
  Eigen::Matrix3Xd points(3, 4);
  points << corner_00, corner_01, corner_10, corner_11;
  return NurbsSurface::fromControlPoints(KnotVector(), KnotVector(), points);
}

NurbsSurface
planePatch(const Eigen::Isometry3d& frame, double size_x, double size_y)
{
  requirePositive(size_x, "size of a plane patch");
  requirePositive(size_y, "size of a plane patch");
  requireRigid(frame);
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 0, size_x, size_x, //
      0, size_y, 0, size_y,       //
      0, 0, 0, 0;
  return NurbsSurface::fromControlPoints(KnotVector::bezier(1, 0.0, size_x),
                                         KnotVector::bezier(1, 0.0, size_y),
                                         points)
      .transformed(frame);
}

NurbsSurface
cylinder(const Eigen::Isometry3d& frame,
         double radius,
         double height,
         const AngleRange& sweep)
{
  requirePositive(radius, "radius of a cylinder");
  return frustum(frame, radius, radius, height, sweep);
}

NurbsSurface
frustum(const Eigen::Isometry3d& frame,
        double radius_bottom,
        double radius_top,
        double height,
        const AngleRange& sweep)
{
  if (!(radius_bottom >= 0.0) || !(radius_top >= 0.0))
    throw std::invalid_argument("a radius of a frustum is negative");
  requirePositive(std::max(radius_bottom, radius_top), "radius of a frustum");
  requirePositive(height, "height of a surface of revolution");
  NurbsCurve2::Points profile(2, 2);
  profile << radius_bottom, radius_top, 0.0, height;
  return revolveProfile(
      frame,
      NurbsCurve2::fromControlPoints(KnotVector::bezier(1, 0.0, height), profile),
      sweep);
}

NurbsSurface
cone(const Eigen::Isometry3d& frame,
     double radius,
     double height,
     const AngleRange& sweep)
{
  return frustum(frame, radius, 0.0, height, sweep);
}

NurbsSurface
sphere(const Eigen::Isometry3d& frame,
       double radius,
       const AngleRange& longitude,
       const AngleRange& latitude)
{
  requireLatitudes(latitude);
  return revolveProfile(
      frame, circularArc(Eigen::Isometry2d::Identity(), radius, latitude), longitude);
}

NurbsSurface
torus(const Eigen::Isometry3d& frame,
      double radius_major,
      double radius_minor,
      const AngleRange& around,
      const AngleRange& tube)
{
  requirePositive(radius_major, "major radius of a torus");
  Eigen::Isometry2d centre = Eigen::Isometry2d::Identity();
  centre.translation().x() = radius_major;
  const NurbsCurve2 profile = circularArc(centre, radius_minor, tube);
  if (radius_major + radius_minor * minimumCosine(tube) < 0.0)
    throw std::invalid_argument("torus: the tube crosses the axis");
  return revolveProfile(frame, profile, around);
}

} // namespace nurbs
} // namespace pcl
