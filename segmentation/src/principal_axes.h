// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_layout.h>

namespace pcl {
namespace nurbs {

/** Grid axes of a cloud taken as a height field: forward is the direction of least
 * extent, or the coordinate axis within 20 degrees of it, and looks down. */
Eigen::Matrix3d
principalAxes(const PointList& points);

} // namespace nurbs
} // namespace pcl
