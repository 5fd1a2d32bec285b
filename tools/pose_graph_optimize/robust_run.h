// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph_robust.h>

#include <nlohmann/json.hpp>

namespace pcl_nurbs_tools {

/** A graph that was optimised without its false loops. */
struct RobustRun {
  pcl::nurbs::PoseGraph graph; /**< without the edges that were rejected */
  pcl::nurbs::PoseGraphSummary summary;
  /** Numbers, and each rejected edge with the reason; null if there was no such run. */
  nlohmann::json report;
};

RobustRun
runRobustly(pcl::nurbs::PoseGraph graph,
            pcl::nurbs::RobustMethod method,
            const pcl::nurbs::PoseGraphOptions& options);

/** One line about it. */
void
printRobust(const nlohmann::json& report);

} // namespace pcl_nurbs_tools
