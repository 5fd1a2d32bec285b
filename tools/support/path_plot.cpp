// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "path_plot.h"

#include "view_axes.h"

namespace pcl_nurbs_tools {

using pcl::nurbs::StampedPose;

LinePlot
pathPlot(const std::vector<std::pair<std::string, pcl::nurbs::Trajectory>>& paths)
{
  Eigen::AlignedBox3d box;
  for (const StampedPose& pose : paths.front().second)
    box.extend(pose.T_world_body.translation());
  const ViewAxes axes = axesAcrossLeastExtent(box);
  LinePlot plot{"Paths", axes.across_label, axes.up_label, true, {}};
  for (const auto& [name, trajectory] : paths) {
    plot.lines.push_back({name, {}});
    for (const StampedPose& pose : trajectory)
      plot.lines.back().points.emplace_back(
          pose.T_world_body.translation()(axes.across),
          pose.T_world_body.translation()(axes.up));
  }
  return plot;
}

} // namespace pcl_nurbs_tools
