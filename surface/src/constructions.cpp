// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/constructions.h>

#include "argument_checks.h"

#include <utility>

namespace pcl {
namespace nurbs {

NurbsSurface
revolvedSurface(const NurbsCurve3& generatrix,
                const Eigen::Isometry3d& axis_frame,
                const AngleRange& sweep)
{
  requireRigid(axis_frame);
  const NurbsCurve2 arc = circularArc(Eigen::Isometry2d::Identity(), 1.0, sweep);
  const NurbsCurve3 local = generatrix.transformed(axis_frame.inverse());
  NurbsSurface::HomogeneousPoints points(
      4, arc.numControlPoints() * local.numControlPoints());
  for (int i = 0; i < arc.numControlPoints(); ++i)
    for (int j = 0; j < local.numControlPoints(); ++j) {
      // The control point (a, b, w) of the unit arc acts as the complex number a + i b
      // does: it turns and stretches the point in the plane across the axis.
      const Eigen::Vector3d a = arc.homogeneousPoints().col(i);
      const Eigen::Vector4d g = local.homogeneousPoints().col(j);
      points.col(i * local.numControlPoints() + j) << a.x() * g.x() - a.y() * g.y(),
          a.y() * g.x() + a.x() * g.y(), a.z() * g.z(), a.z() * g.w();
    }
  return NurbsSurface(arc.knots(), local.knots(), std::move(points))
      .transformed(axis_frame);
}

NurbsSurface
translationalSurface(const NurbsCurve3& profile, const NurbsCurve3& trajectory)
{
  const int n = profile.numControlPoints();
  const int m = trajectory.numControlPoints();
  const Eigen::Vector3d start = trajectory.evaluate(trajectory.knots().domainMin());
  NurbsSurface::HomogeneousPoints points(4, n * m);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const Eigen::Vector3d offset = trajectory.controlPoint(j) - start;
      const double weight = trajectory.weight(j);
      const Eigen::Vector4d point = profile.homogeneousPoints().col(i);
      points.col(i * m + j) << weight * (point.head<3>() + point.w() * offset),
          weight * point.w();
    }
  return {profile.knots(), trajectory.knots(), std::move(points)};
}

NurbsSurface
extrudedSurface(const NurbsCurve3& profile, const Eigen::Vector3d& direction)
{
  const double length = direction.stableNorm();
  requirePositive(length, "length of an extrusion");
  NurbsCurve3::Points line(3, 2);
  line << Eigen::Vector3d::Zero(), direction;
  return translationalSurface(
      profile,
      NurbsCurve3::fromControlPoints(KnotVector::bezier(1, 0.0, length), line));
}

} // namespace nurbs
} // namespace pcl
