// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "common_options.h"
#include "drive_choice.h"

#include <pcl/mapping/simulator/drive_writer.h>

#include <cstdint>
#include <string>

namespace pcl_nurbs_tools {

/** What simulate_scans is asked for. */
struct SimulationSettings : DriveChoice {
  CommonOptions common;
  std::string out;
  std::int64_t first = 0; /**< scan */
  std::int64_t scans = 0; /**< 0 for all */
  bool exact = false;
  bool overwrite = false; /**< scans of an earlier run are removed */
  pcl::nurbs::SimulationOptions simulation;
  pcl::nurbs::DriveWriteOptions writing;
};

/** \return false when help or version was asked for and printed
 * \throws ToolError(kUsage) */
bool
parseSettings(int argc, char** argv, SimulationSettings& settings);

} // namespace pcl_nurbs_tools
