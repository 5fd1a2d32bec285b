// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "common_options.h"
#include "drive_choice.h"
#include "settings_table.h"

#include <pcl/mapping/scan_readers.h>
#include <pcl/mapping/slam_pipeline.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace pcl_nurbs_tools {

/** What nurbs_slam is asked for. */
struct SlamSettings {
  CommonOptions common;
  std::string dataset = "auto";
  std::string path;
  std::string sequence = "00";
  std::string out;
  std::string preset = "auto";
  std::string timing = "auto";
  std::string intrinsics; /**< fx,fy,cx,cy, empty for none */
  bool deterministic = false;
  pcl::nurbs::ScanReadOptions reading;
  DriveChoice drive;
  pcl::nurbs::SimulationOptions simulation;
  bool exact = false; /**< a simulated sensor without noise */
  pcl::nurbs::SlamOptions slam;
  nlohmann::json options; /**< all settings, for the report */
};

/** Parse the command line and the file it may name, and choose data set and preset.
 * \return settings, or nothing when --help, --version or --dump-config was answered
 * \throws ToolError(kUsage), boost::program_options::error, pcl::nurbs::InputError */
std::optional<SlamSettings>
parseSlamSettings(int argc, char** argv);

/** Open the data set or build the simulated town.
 * \throws ToolError(kUsage), pcl::nurbs::InputError */
std::unique_ptr<pcl::nurbs::ScanSource>
openDataset(const SlamSettings& settings);

/** The data set's layout by what is in its folder, or what was said.
 * \throws pcl::nurbs::InputError when the folder has none of them */
std::string
layoutOf(const SlamSettings& settings);

} // namespace pcl_nurbs_tools
