// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/demo_scene.h>
#include <pcl/mapping/simulator/counter_random.h>

#include "demo_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kCameraHeight = 1.4;
constexpr double kCameraPitch = 25.0 * M_PI / 180.0; // downwards
// Depth camera by triangulation: disparity = focal length times base / depth.
constexpr double kBase = 0.075;
constexpr double kDisparityNoise = 0.06;     // pixels
constexpr double kDisparityStep = 1.0 / 8.0; // pixels
constexpr std::int64_t kMostPixels = 1 << 26U;

/** Rows are the camera's axes in the room. */
Eigen::Matrix3d
cameraAxes()
{
  const double s = std::sin(kCameraPitch);
  const double c = std::cos(kCameraPitch);
  Eigen::Matrix3d axes;
  axes << 1, 0, 0, 0, -s, -c, 0, c, -s;
  return axes;
}

Eigen::Vector3d
toRoom(const Eigen::Vector3d& camera)
{
  return cameraAxes().transpose() * camera + kCameraHeight * Eigen::Vector3d::UnitZ();
}

/** Very nearly normal deviate: a sum of twelve uniform ones, which every machine adds
 * up to the same bits. */
double
deviate(std::uint64_t seed, std::uint64_t pixel)
{
  double sum = -6.0;
  for (std::uint64_t i = 0; i < 12; ++i)
    sum += static_cast<double>(scramble(scramble(seed) + 12 * pixel + i) >> 11U) *
           0x1.0p-53;
  return sum;
}

} // namespace

DemoScene::DemoScene(const DemoSceneOptions& options)
    : surfaces_(makeDemoSurfaces()), noisy_(options.noise)
{
  if (options.width < 1 || options.height < 1 ||
      static_cast<std::int64_t>(options.width) * options.height > kMostPixels)
    throw std::invalid_argument("DemoScene: the image has no pixels or too many");
  const double focal = 525.0 * options.width / 640.0;
  intrinsics_ = {
      focal, focal, 0.5 * (options.width - 1.0), 0.5 * (options.height - 1.0)};
  render(options);
}

DemoScene::~DemoScene() = default;

void
DemoScene::render(const DemoSceneOptions& options)
{
  cloud_ = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>(
      static_cast<std::uint32_t>(options.width),
      static_cast<std::uint32_t>(options.height));
  labels_.assign(cloud_->size(), 0);
  const Eigen::Vector3d origin = toRoom(Eigen::Vector3d::Zero());
  const Eigen::Matrix3d to_room = cameraAxes().transpose();
  const double disparity_at_1m = intrinsics_.fx * kBase;
  for (std::size_t i = 0; i < cloud_->size(); ++i) {
    const auto column = static_cast<double>(i % cloud_->width);
    const auto row = static_cast<double>(i / cloud_->width);
    const Eigen::Vector3d pixel((column - intrinsics_.cx) / intrinsics_.fx,
                                (row - intrinsics_.cy) / intrinsics_.fy,
                                1.0);
    const Eigen::Vector3d ray = to_room * pixel.normalized();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < surfaces_.size(); ++s) {
      const double along = surfaces_[s]->cast(origin, ray);
      if (along < nearest) {
        nearest = along;
        labels_[i] = static_cast<std::uint32_t>(s) + 1;
      }
    }
    double depth = nearest / pixel.norm();
    if (noisy_) {
      const double exact = disparity_at_1m / depth;
      const double noisy = exact + kDisparityNoise * deviate(options.seed, i);
      depth = disparity_at_1m / (std::round(noisy / kDisparityStep) * kDisparityStep);
    }
    (*cloud_)[i].getVector3fMap() = (depth * pixel).cast<float>();
  }
}

SensorNoise
DemoScene::noise() const
{
  if (!noisy_)
    return {};
  const double variance =
      kDisparityNoise * kDisparityNoise + kDisparityStep * kDisparityStep / 12.0;
  return {0.0, std::sqrt(variance) / (intrinsics_.fx * kBase), 0.0};
}

const DemoSurface&
DemoScene::surface(std::uint32_t label) const
{
  if (label < 1 || label > surfaces_.size())
    throw std::invalid_argument("DemoScene: there is no surface " +
                                std::to_string(label));
  return *surfaces_[label - 1];
}

const std::string&
DemoScene::surfaceName(std::uint32_t label) const
{
  return surface(label).name();
}

double
DemoScene::distance(std::uint32_t label, const Eigen::Vector3d& point) const
{
  return surface(label).distance(toRoom(point));
}

double
DemoScene::distance(const Eigen::Vector3d& point) const
{
  const Eigen::Vector3d place = toRoom(point);
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& surface : surfaces_)
    nearest = std::min(nearest, surface->distance(place));
  return nearest;
}

} // namespace nurbs
} // namespace pcl
