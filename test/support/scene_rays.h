// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "registration_scenes.h"

#include <pcl/registration/voxel_map.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace nurbs {
namespace test {

/** Distance along a ray (unit direction) to a surface, infinity when it misses. */
inline double
rayDistance(const SceneSurface& surface,
            const Eigen::Vector3d& origin,
            const Eigen::Vector3d& direction)
{
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d from = origin - surface.corner;
  if (surface.radius > 0.0) { // upright cylinder
    const double a = direction.head<2>().squaredNorm();
    const double b = from.head<2>().dot(direction.head<2>());
    const double c = from.head<2>().squaredNorm() - surface.radius * surface.radius;
    const double root = b * b - a * c;
    if (root < 0.0 || a == 0.0)
      return kMiss;
    const double distance = (-b - std::sqrt(root)) / a;
    const double height = from.z() + distance * direction.z();
    return distance > 0.0 && height >= 0.0 && height <= surface.v.z() ? distance
                                                                      : kMiss;
  }
  const Eigen::Vector3d normal = surface.u.cross(surface.v);
  const double distance = -from.dot(normal) / direction.dot(normal);
  const Eigen::Vector3d at = from + distance * direction;
  const double u = at.dot(surface.u) / surface.u.squaredNorm();
  const double v = at.dot(surface.v) / surface.v.squaredNorm();
  const bool hit = distance > 0.0 && u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0;
  return hit ? distance : kMiss;
}

/** What a ray meets first. */
inline double
rayDistance(const Scene& scene,
            const Eigen::Vector3d& origin,
            const Eigen::Vector3d& direction)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (const SceneSurface& surface : scene)
    nearest = std::min(nearest, rayDistance(surface, origin, direction));
  return nearest;
}

/** A turning laser of some beams between two elevations, in its own frame; ranges have
 * noise. */
inline ScanPoints
ringScan(const Scene& scene,
         const Eigen::Isometry3d& pose,
         int beams,
         int columns,
         double noise,
         std::mt19937& random)
{
  constexpr double kLowest = -0.43;
  constexpr double kHighest = 0.2;
  constexpr double kFarthest = 60.0;
  std::normal_distribution<double> normal;
  ScanPoints points;
  for (int i = 0; i < beams; ++i)
    for (int k = 0; k < columns; ++k) {
      const double up = kLowest + (kHighest - kLowest) * i / (beams - 1);
      const double turn = 2.0 * M_PI * k / columns;
      const Eigen::Vector3d beam(
          std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
      const double range = rayDistance(scene, pose.translation(), pose.linear() * beam);
      if (range < kFarthest)
        points.emplace_back(((range + noise * normal(random)) * beam).cast<float>());
    }
  return points;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
