// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "common_options.h"

#include <pcl/mapping/pose_graph_robust.h>

#include <optional>
#include <string>

namespace pcl_nurbs_tools {

/** Where the estimates come from before they are optimised. */
enum class StartKind { File, Chordal, None, Random };

/** What the command line of pose_graph_optimize asks for, checked. */
struct GraphSettings {
  CommonOptions common;
  std::string input;
  std::string output; /**< empty for none, as the following ones */
  std::string kitti;
  std::string tum;
  std::string plots;
  std::string init_word;
  std::string cost_word;
  std::string method_word;
  std::string robust_word;
  StartKind start = StartKind::File;
  unsigned seed = 1;
  bool local = false;
  bool incremental = false;
  bool strict = false;
  pcl::nurbs::PoseGraphOptions solver;
  /** How false loops are found, if they are to be. */
  std::optional<pcl::nurbs::RobustMethod> robust;
};

/** Parse the command line.
 * \return settings, or nothing if --help or --version has been answered
 * \throws ToolError(kUsage) or boost::program_options::error naming what is wrong */
std::optional<GraphSettings>
parseGraphSettings(int argc, char** argv);

} // namespace pcl_nurbs_tools
