// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/rigid_motion.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>
#include <vector>

namespace pcl {
namespace nurbs {
namespace bench {

/** Two scans and the motion from the source's frame to the target's. */
struct ScanPair {
  pcl::PointCloud<pcl::PointXYZ>::Ptr target;
  pcl::PointCloud<pcl::PointXYZ>::Ptr source;
  Eigen::Isometry3d truth;
};

/** Pairs of one sensor in one place, and what is near and far to it. */
struct PairSet {
  std::vector<ScanPair> pairs;
  /** Error of a good guess: metres and radians. Rougher ones are multiples of it. */
  double guess_translation = 0.2;
  double guess_rotation = 0.02;
  /** A result as near to the truth as this has come home: metres and radians. */
  double home_translation = 0.1;
  double home_rotation = 0.01;
  /** Typical distance of neighbours within the thinned clouds, metres. */
  double spacing = 0.2;
};

/** Names that pairSet() knows. */
const std::vector<std::string>&
pairSetNames();

/** All methods get the same clouds: one point per voxel, cropped to the sensor's range.
 * \return no pairs when the data set is not there */
PairSet
pairSet(const std::string& name);

} // namespace bench
} // namespace nurbs
} // namespace pcl
