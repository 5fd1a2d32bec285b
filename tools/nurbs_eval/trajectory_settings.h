// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "common_options.h"

#include <pcl/mapping/trajectory_metrics.h>

#include <optional>
#include <string>

namespace pcl_nurbs_tools {

/** What the command line of nurbs_eval trajectory asks for, checked. */
struct TrajectorySettings {
  CommonOptions common;
  std::string reference;
  std::string estimate;
  std::string reference_times;
  std::string estimate_times;
  std::string plots;
  std::string align_word;
  std::string step_word;
  pcl::nurbs::TrajectoryAlignment alignment = pcl::nurbs::TrajectoryAlignment::SE3;
  double step = 1.0;
  pcl::nurbs::RelativeUnit unit = pcl::nurbs::RelativeUnit::Poses;
  double max_difference = 0.01; /**< seconds */
};

/** Parse the command line; argv[0] is the command's name.
 * \return settings, or nothing if --help or --version has been answered
 * \throws ToolError(kUsage) or boost::program_options::error naming what is wrong */
std::optional<TrajectorySettings>
parseTrajectorySettings(int argc, char** argv);

} // namespace pcl_nurbs_tools
