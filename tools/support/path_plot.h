// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "line_plot.h"

#include <pcl/mapping/trajectory.h>

#include <string>
#include <utility>
#include <vector>

namespace pcl_nurbs_tools {

/** Paths of trajectories seen along the axis in which the first one has the least
 * extent: a drive is seen from above in a camera's frame as in a map's. */
LinePlot
pathPlot(const std::vector<std::pair<std::string, pcl::nurbs::Trajectory>>& paths);

} // namespace pcl_nurbs_tools
