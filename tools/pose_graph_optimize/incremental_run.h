// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/incremental_pose_graph.h>

#include <functional>

namespace pcl_nurbs_tools {

/** What it took to estimate a graph while it grew. */
struct IncrementalRun {
  pcl::nurbs::PoseGraph graph;
  std::vector<double> seconds; /**< of each update, with its vertex and edges added */
  double eliminated = 0.0;     /**< poses per update */
  double solved = 0.0;
  /** Cost when all was added, before all poses were optimised together. */
  double cost_before_all = 0.0;
  pcl::nurbs::PoseGraphSummary all;
};

/** Add the vertices of a graph in the order of their names, each with the edges that
 * lead to earlier ones, and estimate after each; then all together.
 * \param[in] graph of which the estimates are used only where no edge leads to a vertex
 * \param[in] progress told the share that is done */
IncrementalRun
runIncrementally(const pcl::nurbs::PoseGraph& graph,
                 const pcl::nurbs::PoseGraphOptions& options,
                 const std::function<void(double)>& progress);

} // namespace pcl_nurbs_tools
