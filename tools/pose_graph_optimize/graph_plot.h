// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph.h>

#include <string>

namespace pcl_nurbs_tools {

/** Draw a graph to a PNG file: its nodes in the order of their names, and its other
 * edges, seen along the axis of least extent.
 * \throws ToolError(kCannotWrite) naming file and reason */
void
writeGraphPlot(const std::string& path,
               const std::string& title,
               const pcl::nurbs::PoseGraph& graph);

} // namespace pcl_nurbs_tools
