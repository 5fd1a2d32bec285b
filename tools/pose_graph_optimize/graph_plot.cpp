// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "graph_plot.h"

#include "line_plot.h"
#include "view_axes.h"

#include <limits>

namespace pcl_nurbs_tools {

using namespace pcl::nurbs;

void
writeGraphPlot(const std::string& path,
               const std::string& title,
               const PoseGraph& graph)
{
  Eigen::AlignedBox3d box;
  for (const auto& [id, node] : graph.nodes())
    box.extend(node.T_world_node.translation());
  const ViewAxes axes = axesAcrossLeastExtent(box);
  LinePlot plot{
      title, axes.across_label, axes.up_label, true, {{"edges", {}}, {"path", {}}}};
  const auto point = [&](NodeId id) -> std::pair<double, double> {
    const Eigen::Vector3d position = graph.node(id).T_world_node.translation();
    return {position(axes.across), position(axes.up)};
  };
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [id, factor] : graph.factors())
    if (const auto* between = std::get_if<BetweenFactor>(&factor.measurement)) {
      auto& line = plot.lines[0].points;
      line.push_back(point(between->from));
      line.push_back(point(between->to));
      line.emplace_back(nothing, nothing);
    }
  for (const auto& [id, node] : graph.nodes())
    plot.lines[1].points.push_back(point(id));
  writePlot(path, plot);
}

} // namespace pcl_nurbs_tools
