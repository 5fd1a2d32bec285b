// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>

#include <cmath>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

/** Knots of a circle in \a arcs quarter turns, domain [0, arcs]. */
inline KnotVector
quarterTurns(int arcs)
{
  std::vector<double> knots = {0, 0, 0};
  for (int k = 1; k < arcs; ++k)
    knots.insert(knots.end(), 2, k);
  knots.insert(knots.end(), 3, arcs);
  return {2, knots};
}

/** Control points (r, z, weight) of quarter turns of a circle from \a start degrees. */
inline Eigen::Matrix3Xd
arcProfile(double centre, double radius, int start_quarter, int arcs)
{
  Eigen::Matrix3Xd profile(3, 2 * arcs + 1);
  for (int k = 0; k <= 2 * arcs; ++k) {
    const double angle = M_PI / 4.0 * (2 * start_quarter + k);
    const double weight = k % 2 == 0 ? 1.0 : std::sqrt(0.5);
    profile.col(k) << centre + radius / weight * std::cos(angle),
        radius / weight * std::sin(angle), weight;
  }
  return profile;
}

/** Surface of revolution about z, exact, normal outwards if the profile goes up. */
inline NurbsSurface
revolved(const KnotVector& profile_knots, const Eigen::Matrix3Xd& profile)
{
  const KnotVector around = quarterTurns(4);
  Eigen::Matrix3Xd points(3, 9 * profile.cols());
  Eigen::VectorXd weights(points.cols());
  for (Eigen::Index i = 0; i < 9; ++i)
    for (Eigen::Index j = 0; j < profile.cols(); ++j) {
      const double angle = M_PI / 4.0 * static_cast<double>(i % 8);
      const double weight = i % 2 == 0 ? 1.0 : std::sqrt(0.5);
      const double r = profile(0, j) / weight;
      points.col(i * profile.cols() + j) << r * std::cos(angle), r * std::sin(angle),
          profile(1, j);
      weights(i * profile.cols() + j) = weight * profile(2, j);
    }
  return NurbsSurface::fromControlPoints(around, profile_knots, points, weights);
}

inline NurbsSurface
sphere(double radius)
{
  return revolved(quarterTurns(2), arcProfile(0.0, radius, -1, 2));
}

inline NurbsSurface
torus(double major, double minor)
{
  return revolved(quarterTurns(4), arcProfile(major, minor, 0, 4));
}

inline NurbsSurface
cylinder(double radius, double height)
{
  Eigen::Matrix3Xd profile(3, 2);
  profile << radius, radius, 0.0, height, 1.0, 1.0;
  return revolved(KnotVector::bezier(1), profile);
}

} // namespace test
} // namespace nurbs
} // namespace pcl
