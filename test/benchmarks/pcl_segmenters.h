// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {
namespace bench {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** Label per point of an organized cloud, 0 for none. */
using Segmenter = std::function<std::vector<std::uint32_t>(const Cloud::ConstPtr&)>;

/** A method with one set of parameters. */
struct Setting {
  std::string parameters;
  Segmenter segment;
};

/** A method and the settings to choose from. */
struct Method {
  std::string name;
  std::vector<Setting> settings;
};

/** How large things are, which PCL's parameters depend on. */
enum class SceneScale { Room, Street };

/** PCL's own: OrganizedMultiPlaneSegmentation, RegionGrowing, SupervoxelClustering,
 * the same with LCCPSegmentation, EuclideanClusterExtraction. */
std::vector<Method>
pclMethods(SceneScale scale);

} // namespace bench
} // namespace nurbs
} // namespace pcl
