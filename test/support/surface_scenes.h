// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "grid_clouds.h"
#include "label_checks.h"

#include <pcl/segmentation/surface_grouping.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

/** Camera of all scenes. */
inline const GridGeometry kCamera =
    GridGeometry::pinhole(320, 240, {262.5, 262.5, 159.5, 119.5});

/** What a ray through a pixel meets. */
struct Hit {
  double depth;
  std::uint32_t surface;
};

/** A grouped view of a scene. */
struct GroupedScene {
  GridPoints points;
  LabelImage truth;
  LabelImage labels;
  std::vector<SurfaceGroup> groups;
};

/** Ray (u, v, 1) of a pixel. */
inline Eigen::Vector3d
ray(int column, int row)
{
  return {kCamera.first_u + column * kCamera.step_u,
          kCamera.first_v + row * kCamera.step_v,
          1.0};
}

/** Depth where a ray meets the plane n.p = d; infinite behind the camera. */
inline double
planeDepth(const Eigen::Vector3d& normal, double distance, const Eigen::Vector3d& e)
{
  const double depth = distance / normal.dot(e);
  return depth > 0.0 ? depth : std::numeric_limits<double>::infinity();
}

/** Group a scene, a function (column, row) -> Hit, under the noise of a Kinect times
 * \a noise_factor, stated as that times \a stated_factor. */
template <typename Scene>
GroupedScene
groupScene(const Scene& scene,
           const SurfaceGroupingOptions& options = {},
           double noise_factor = 1.0,
           double stated_factor = 1.0)
{
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  GroupedScene result;
  const SensorNoise kinect = SensorNoise::kinect();
  const auto cloud = cameraCloud(kCamera, [&](int column, int row) {
    const Hit hit = scene(column, row);
    result.truth.push_back(std::isfinite(hit.depth) ? hit.surface : 0);
    return hit.depth + noise_factor * kinect.sigma(hit.depth) * normal(random);
  });
  result.points = toGridPoints(cloud, kCamera);
  const SensorNoise stated{
      stated_factor * kinect.constant, stated_factor * kinect.quadratic, 0.4};
  GridGraph graph;
  graph.build(result.points, stated);
  graph.setWeights();
  groupSurfaces(result.points, graph, stated, options, result.labels, &result.groups);
  return result;
}

inline Hit
nearer(const Hit& a, const Hit& b)
{
  return a.depth <= b.depth ? a : b;
}

/** The corner of a box towards the camera: its three faces. */
inline Hit
boxCorner(int column, int row)
{
  const Eigen::Vector3d e = ray(column, row);
  const double slant = 1.0 / std::sqrt(3.0);
  // Faces meet in (0, 0, 1.2) and go away from the camera: the farthest counts.
  Hit hit{0.0, 0};
  std::uint32_t number = 0;
  for (const double angle : {0.3, 0.3 + 2.0 * M_PI / 3.0, 0.3 + 4.0 * M_PI / 3.0}) {
    const double across = std::sqrt(1.0 - slant * slant);
    const Eigen::Vector3d n(across * std::cos(angle), across * std::sin(angle), slant);
    const double depth = planeDepth(n, 1.2 * slant, e);
    ++number;
    if (depth > hit.depth)
      hit = {depth, number};
  }
  return hit;
}

/** A wall 2 m away with a cylinder in front of it. */
inline Hit
cylinderBeforeWall(int column, int row)
{
  const Eigen::Vector3d e = ray(column, row);
  const Hit wall{2.0, 1};
  const double radius = 0.25;
  const double middle = 1.3;
  const double a = e.x() * e.x() + 1.0;
  const double root = middle * middle - a * (middle * middle - radius * radius);
  return root < 0.0 ? wall : nearer(wall, {(middle - std::sqrt(root)) / a, 2});
}

/** A dome on a floor 1 m below the camera, which looks down by 40 degrees. */
inline Hit
domeOnFloor(int column, int row)
{
  const double pitch = 40.0 * M_PI / 180.0;
  const Eigen::Vector3d down(0.0, std::cos(pitch), std::sin(pitch));
  const Eigen::Vector3d e = ray(column, row);
  const double floor = planeDepth(down, 1.0, e);
  const Eigen::Vector3d centre = planeDepth(down, 1.0, ray(160, 130)) * ray(160, 130);
  const double radius = 0.3;
  const double b = e.dot(centre) / e.squaredNorm();
  const double root =
      b * b - (centre.squaredNorm() - radius * radius) / e.squaredNorm();
  const Hit ground{floor, 1};
  return root < 0.0 ? ground : nearer(ground, {b - std::sqrt(root), 2});
}

} // namespace test
} // namespace nurbs
} // namespace pcl
