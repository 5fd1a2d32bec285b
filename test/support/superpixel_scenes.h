// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "grid_clouds.h"

#include <pcl/segmentation/entropy_rate_segmentation.h>

#include <random>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

inline const GridGeometry kSceneCamera =
    GridGeometry::pinhole(160, 120, {130.0, 130.0, 79.5, 59.5});

template <typename PointT>
EntropyRateSegmentation<PointT>
superpixels(std::size_t number)
{
  EntropyRateSegmentation<PointT> segmentation;
  segmentation.setMode(EntropyRateSegmentation<PointT>::SUPERPIXELS);
  segmentation.setNumberOfSuperpixels(number);
  segmentation.setSensorNoise(SensorNoise::kinect());
  return segmentation;
}

template <typename PointT>
std::vector<PointIndices>
segmentsOf(GridSegmentation<PointT>& segmentation, const PointCloud<PointT>& cloud)
{
  segmentation.setInputCloud(cloud.makeShared());
  std::vector<PointIndices> segments;
  segmentation.segment(segments);
  return segments;
}

/** A wall with a box before it. */
inline pcl::PointCloud<PointXYZ>
boxBeforeWall(unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return cameraCloud(kSceneCamera, [&](int column, int row) {
    const bool box = column >= 50 && column < 110 && row >= 30 && row < 90;
    const double depth = box ? 1.5 : 2.0;
    return depth + 0.3 * SensorNoise::kinect().sigma(depth) * normal(random);
  });
}

/** A flat wall, with what \a paint does to the points of its left half. */
template <typename PointT, typename Paint>
PointCloud<PointT>
paintedWall(const Paint& paint)
{
  const auto plain = cameraCloud(kSceneCamera, [](int, int) { return 2.0; });
  PointCloud<PointT> cloud(plain.width, plain.height);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    cloud[i].getVector3fMap() = plain[i].getVector3fMap();
    paint(cloud[i], i % plain.width < 80);
  }
  return cloud;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
