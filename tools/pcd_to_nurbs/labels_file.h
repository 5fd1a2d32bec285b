// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_nurbs_tools {

/** Write an organized cloud with a label per point as binary PCD, atomically. \a offset
 * is added to the points; if there is one, coordinates are doubles.
 * \throws ToolError(kCannotWrite) naming file and reason */
void
writeLabels(const std::string& path,
            const pcl::PointCloud<pcl::PointXYZ>& cloud,
            const Eigen::Vector3d& offset,
            const std::vector<std::uint32_t>& labels);

} // namespace pcl_nurbs_tools
