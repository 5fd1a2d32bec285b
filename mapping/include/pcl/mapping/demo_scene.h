// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>
#include <pcl/segmentation/sensor_noise.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

class DemoSurface;

/** \brief What DemoScene renders. */
struct DemoSceneOptions {
  int width = 640;
  int height = 480;
  std::uint64_t seed = 1;
  /** Whether the depth camera measures disparities with noise and in steps of 1/8
   * pixel, like a Kinect; otherwise the depths are exact. */
  bool noise = true;
};

/** \brief The built-in example: the corner of a room (floor, two walls, a wavy wall)
 * with a column, a dome, an arch and a box, as a depth camera sees it.
 *
 * All surfaces are analytic and met exactly by the camera's rays, so that the true
 * surface of every pixel and the true distance of every point are known. The same
 * options give the same bytes.
 *
 * Coordinates are those of the camera (x right, y down, z forward), in metres.
 * \ingroup mapping
 */
class PCL_NURBS_MAPPING_EXPORT DemoScene {
public:
  /** \brief Render the scene.
   * \throws std::invalid_argument when the image has no pixels or more than 2^26
   */
  explicit DemoScene(const DemoSceneOptions& options = {});

  ~DemoScene();
  DemoScene(const DemoScene&) = delete;
  DemoScene&
  operator=(const DemoScene&) = delete;

  /** \brief The organized cloud the camera measured. */
  const pcl::PointCloud<pcl::PointXYZ>::Ptr&
  cloud() const
  {
    return cloud_;
  }

  const PinholeIntrinsics&
  intrinsics() const
  {
    return intrinsics_;
  }

  /** \brief Depth noise of the camera, as a function of depth. */
  SensorNoise
  noise() const;

  /** \brief True surface of each pixel, 1..numSurfaces(). */
  const std::vector<std::uint32_t>&
  labels() const
  {
    return labels_;
  }

  std::uint32_t
  numSurfaces() const
  {
    return static_cast<std::uint32_t>(surfaces_.size());
  }

  /** \brief What a surface is, e.g. "floor".
   * \throws std::invalid_argument when there is no such surface */
  const std::string&
  surfaceName(std::uint32_t label) const;

  /** \brief Exact distance of a point from a surface (unbounded where the room's walls
   * and floor are; below the floor the arch and dome go on).
   * \throws std::invalid_argument when there is no such surface */
  double
  distance(std::uint32_t label, const Eigen::Vector3d& point) const;

  /** \brief Exact distance of a point from the nearest surface. */
  double
  distance(const Eigen::Vector3d& point) const;

private:
  const DemoSurface&
  surface(std::uint32_t label) const;

  void
  render(const DemoSceneOptions& options);

  std::vector<std::unique_ptr<DemoSurface>> surfaces_;
  PinholeIntrinsics intrinsics_;
  bool noisy_;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud_;
  std::vector<std::uint32_t> labels_;
};

} // namespace nurbs
} // namespace pcl
