// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pcl_nurbs_tools {

/** A line through points (x, y); a point that is not finite interrupts it. */
struct PlotLine {
  std::string name; /**< for the legend, empty for none */
  std::vector<std::pair<double, double>> points;
};

/** Lines over two axes. */
struct LinePlot {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool same_scale = false; /**< a unit is as long in x as in y, as on a map */
  std::vector<PlotLine> lines;
};

/** Draw a plot to a PNG file.
 * \throws ToolError(kCannotWrite) naming file and reason */
void
writePlot(const std::string& path, const LinePlot& plot);

} // namespace pcl_nurbs_tools
