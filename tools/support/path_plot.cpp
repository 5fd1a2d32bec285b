// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "path_plot.h"

namespace pcl_nurbs_tools {

using pcl::nurbs::StampedPose;

LinePlot
pathPlot(const std::vector<std::pair<std::string, pcl::nurbs::Trajectory>>& paths)
{
  static const char* const names[] = {"x (m)", "y (m)", "z (m)"};
  Eigen::AlignedBox3d box;
  for (const StampedPose& pose : paths.front().second)
    box.extend(pose.T_world_body.translation());
  Eigen::Index least = 0;
  box.sizes().minCoeff(&least);
  const Eigen::Index across = least == 0 ? 1 : 0;
  const Eigen::Index up = least == 2 ? 1 : 2;
  LinePlot plot{"Paths", names[across], names[up], true, {}};
  for (const auto& [name, trajectory] : paths) {
    plot.lines.push_back({name, {}});
    for (const StampedPose& pose : trajectory)
      plot.lines.back().points.emplace_back(pose.T_world_body.translation()(across),
                                            pose.T_world_body.translation()(up));
  }
  return plot;
}

} // namespace pcl_nurbs_tools
