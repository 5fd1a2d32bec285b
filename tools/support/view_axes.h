// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Geometry>

namespace pcl_nurbs_tools {

/** Which coordinates go across and up in a picture. */
struct ViewAxes {
  Eigen::Index across = 0;
  Eigen::Index up = 1;
  const char* across_label = "";
  const char* up_label = "";
};

/** Look along the axis of least extent, so that a drive is seen from above in a
 * camera's frame as in a map's. */
ViewAxes
axesAcrossLeastExtent(const Eigen::AlignedBox3d& box);

} // namespace pcl_nurbs_tools
