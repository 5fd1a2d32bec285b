// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/rigid_motion.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Geometry>

#include <cmath>
#include <random>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

/** A rectangle or a cylinder's side, sampled evenly by (u, v) in the unit square. */
struct SceneSurface {
  Eigen::Vector3d corner;
  Eigen::Vector3d u;
  Eigen::Vector3d v;
  double radius = 0.0; // of a cylinder about v; u is then unused

  Eigen::Vector3d
  point(double a, double b) const
  {
    if (radius > 0.0)
      return corner + b * v +
             radius *
                 Eigen::Vector3d(std::cos(2 * M_PI * a), std::sin(2 * M_PI * a), 0);
    return corner + a * u + b * v;
  }

  double
  area() const
  {
    return radius > 0.0 ? 2 * M_PI * radius * v.norm() : u.cross(v).norm();
  }
};

using Scene = std::vector<SceneSurface>;

/** Adds the four walls and the lid of a box that stands on z = bottom. */
inline void
addBox(Scene& scene,
       const Eigen::Vector3d& corner,
       const Eigen::Vector3d& size,
       double yaw = 0.0)
{
  const Eigen::AngleAxisd turn(yaw, Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d x = turn * Eigen::Vector3d(size.x(), 0, 0);
  const Eigen::Vector3d y = turn * Eigen::Vector3d(0, size.y(), 0);
  const Eigen::Vector3d z(0, 0, size.z());
  scene.push_back({corner, x, z});
  scene.push_back({corner, y, z});
  scene.push_back({corner + x, y, z});
  scene.push_back({corner + y, x, z});
  scene.push_back({corner + z, x, y});
}

inline Scene
ground(double half)
{
  return {{{-half, -half, -1.7}, {2 * half, 0, 0}, {0, 2 * half, 0}}};
}

/** A street: ground, two rows of houses with gaps, cars, poles. */
inline Scene
street()
{
  Scene scene = ground(20);
  for (int i = -2; i < 2; ++i) {
    addBox(scene, {10.0 * i, 8.0 + 0.5 * i, -1.7}, {8, 6, 7}, 0.02 * i);
    addBox(scene, {10.0 * i + 3, -14.0 + 0.7 * i, -1.7}, {8, 5, 6}, -0.03 * i);
    addBox(scene, {7.0 * i + 2, 4.0, -1.7}, {4, 1.8, 1.5}, 0.1);
    scene.push_back({{9.0 * i + 4, -5, -1.7}, {0, 0, 0}, {0, 0, 5}, 0.15});
  }
  return scene;
}

/** A room with furniture. */
inline Scene
room()
{
  Scene scene;
  addBox(scene, {-3, -2.5, -1.2}, {6, 5, 2.6});
  scene.push_back({{-3, -2.5, -1.2}, {6, 0, 0}, {0, 5, 0}});
  addBox(scene, {0.5, 0.8, -1.2}, {1.5, 0.8, 0.75}, 0.3);
  addBox(scene, {-2.5, -2, -1.2}, {0.6, 1.2, 1.9}, -0.2);
  scene.push_back({{-1, 1.2, -1.2}, {0, 0, 0}, {0, 0, 1.0}, 0.3});
  return scene;
}

/** Columns of several sizes on the ground: curved surfaces mostly. */
inline Scene
columns()
{
  Scene scene = ground(10);
  for (int i = 0; i < 8; ++i)
    scene.push_back({{9 * std::cos(0.8 * i), 7 * std::sin(0.8 * i), -1.7},
                     {0, 0, 0},
                     {0, 0, 4.0},
                     0.6 + 0.12 * i});
  return scene;
}

/** Two parallel walls, floor and ceiling along x, open at both ends. */
inline Scene
corridor()
{
  const Eigen::Vector3d along(40, 0, 0);
  return {{{-20, -1.5, -1.5}, along, {0, 3, 0}},
          {{-20, -1.5, -1.5}, along, {0, 0, 3}},
          {{-20, 1.5, -1.5}, along, {0, 0, 3}},
          {{-20, -1.5, 1.5}, along, {0, 3, 0}}};
}

/** Points spread evenly over a scene's area, each moved by noise in every coordinate.
 */
inline std::vector<Eigen::Vector3d>
sampleScene(const Scene& scene, int count, double noise, std::mt19937& random)
{
  std::vector<double> areas;
  for (const SceneSurface& surface : scene)
    areas.push_back(surface.area());
  std::discrete_distribution<std::size_t> choose(areas.begin(), areas.end());
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const SceneSurface& surface = scene[choose(random)];
    const double a = uniform(random);
    Eigen::Vector3d point = surface.point(a, uniform(random));
    for (int k = 0; k < 3; ++k)
      point[k] += noise * normal(random);
    points.push_back(point);
  }
  return points;
}

/** Points as a sensor at a pose sees them. */
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
cloudSeenFrom(const Eigen::Isometry3d& pose, const std::vector<Eigen::Vector3d>& points)
{
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  const Eigen::Isometry3d inverse = pose.inverse();
  for (const Eigen::Vector3d& point : points) {
    PointT seen;
    seen.getVector3fMap() = (inverse * point).cast<float>();
    cloud->push_back(seen);
  }
  return cloud;
}

/** A motion of given length and angle in a random direction. */
inline Eigen::Isometry3d
randomMotion(double translation, double rotation, std::mt19937& random)
{
  std::normal_distribution<double> normal;
  Eigen::Vector3d along;
  Eigen::Vector3d about;
  for (int k = 0; k < 3; ++k) {
    along[k] = normal(random);
    about[k] = normal(random);
  }
  Tangent tangent;
  tangent << translation * along.normalized(), rotation * about.normalized();
  return exponential(tangent);
}

} // namespace test
} // namespace nurbs
} // namespace pcl
