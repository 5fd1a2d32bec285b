// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// What a user's first program does with the installed kernel; exit code 0 if the
// results are right.

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <cstdio>
#include <stdexcept>

namespace {

using pcl::nurbs::KnotVector;
using pcl::nurbs::NurbsSurface;

/** The hyperbolic paraboloid z = x y over the unit square. */
NurbsSurface
saddle()
{
  Eigen::Matrix3Xd points(3, 4);
  points.col(0) << 0.0, 0.0, 0.0;
  points.col(1) << 0.0, 1.0, 0.0;
  points.col(2) << 1.0, 0.0, 0.0;
  points.col(3) << 1.0, 1.0, 1.0;
  return NurbsSurface::fromControlPoints(
      KnotVector::bezier(1), KnotVector::bezier(1), points);
}

/** Exceptions must be caught by type across the border of the shared library. */
bool
badKnotsAreRefused()
{
  try {
    KnotVector(3, {0.0, 1.0});
  } catch (const std::invalid_argument&) {
    return true;
  }
  return false;
}

} // namespace

int
main()
{
  const Eigen::Vector3d point = saddle().evaluate(0.25, 0.5);
  const double error = (point - Eigen::Vector3d(0.25, 0.5, 0.125)).norm();
  std::printf("S(0.25, 0.5) = %g %g %g\n", point.x(), point.y(), point.z());
  return error < 1e-15 && badKnotsAreRefused() ? 0 : 1;
}
