// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "view_axes.h"

namespace pcl_nurbs_tools {

ViewAxes
axesAcrossLeastExtent(const Eigen::AlignedBox3d& box)
{
  static const char* const names[] = {"x (m)", "y (m)", "z (m)"};
  Eigen::Index least = 2;
  box.sizes().minCoeff(&least);
  ViewAxes axes;
  axes.across = least == 0 ? 1 : 0;
  axes.up = least == 2 ? 1 : 2;
  axes.across_label = names[axes.across];
  axes.up_label = names[axes.up];
  return axes;
}

} // namespace pcl_nurbs_tools
