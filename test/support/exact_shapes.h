// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <cmath>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

/** Full turn as four rational quadratic arcs: knots on [0, 4]. */
inline KnotVector
circleKnots()
{
  return {2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}};
}

/** Unit circle of the xy plane, homogeneous. */
inline Eigen::Matrix4Xd
circlePoints()
{
  const double s = std::sqrt(0.5);
  Eigen::Matrix4Xd points(4, 9);
  points << 1, s, 0, -s, -1, -s, 0, s, 1, //
      0, s, 1, s, 0, -s, -1, -s, 0,       //
      0, 0, 0, 0, 0, 0, 0, 0, 0,          //
      1, s, 1, s, 1, s, 1, s, 1;
  return points;
}

/** Profile in the xz half plane turned about z: u along the profile, v around. */
inline NurbsSurface
revolved(const KnotVector& profile_knots, const Eigen::Matrix4Xd& profile)
{
  const Eigen::Matrix4Xd circle = circlePoints();
  Eigen::Matrix4Xd points(4, profile.cols() * circle.cols());
  for (Eigen::Index i = 0; i < profile.cols(); ++i)
    for (Eigen::Index j = 0; j < circle.cols(); ++j) {
      const double w = circle(3, j);
      points.col(i * circle.cols() + j) << profile(0, i) * circle(0, j),
          profile(0, i) * circle(1, j), profile(2, i) * w, profile(3, i) * w;
    }
  return {profile_knots, circleKnots(), NurbsSurface::HomogeneousPoints(points)};
}

/** Sphere about the origin with poles on the z axis (u = 0 is the south pole). */
inline NurbsSurface
sphere(double radius)
{
  const double s = std::sqrt(0.5);
  Eigen::Matrix4Xd half(4, 5);
  half << 0, s, 1, s, 0, //
      0, 0, 0, 0, 0,     //
      -1, -s, 0, s, 1,   //
      1, s, 1, s, 1;
  half.topRows(3) *= radius;
  return revolved({2, {0, 0, 0, 1, 1, 2, 2, 2}}, half);
}

/** Cylinder about z, z in [0, height]. */
inline NurbsSurface
cylinder(double radius, double height)
{
  Eigen::Matrix4Xd line(4, 2);
  line << radius, radius, 0, 0, 0, height, 1, 1;
  return revolved(KnotVector::bezier(1), line);
}

/** Torus about z, closed in both directions. */
inline NurbsSurface
torus(double major, double minor)
{
  const Eigen::Matrix4Xd circle = circlePoints();
  Eigen::Matrix4Xd tube(4, 9);
  tube.row(0) = minor * circle.row(0) + major * circle.row(3);
  tube.row(1).setZero();
  tube.row(2) = minor * circle.row(1);
  tube.row(3) = circle.row(3);
  return revolved(circleKnots(), tube);
}

/** Height field z = f(x, y) over [-1, 1]^2: control heights sampled at the Greville
 * abscissae, so x = u and y = v exactly. */
template <typename Height>
NurbsSurface
heightField(int degree, int spans, Height height)
{
  const KnotVector knots = KnotVector::clampedUniform(degree, spans, -1.0, 1.0);
  const int n = knots.numControlPoints();
  Eigen::Matrix3Xd points(3, n * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = knots.greville(i);
      const double y = knots.greville(j);
      points.col(i * n + j) << x, y, height(x, y);
    }
  return NurbsSurface::fromControlPoints(knots, knots, points);
}

} // namespace test
} // namespace nurbs
} // namespace pcl
