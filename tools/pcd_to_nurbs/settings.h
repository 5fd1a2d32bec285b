// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "common_options.h"
#include "surface_output.h"
#include "surface_picture.h"

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/nurbs_reconstruction.h>

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pcl_nurbs_tools {

/** How a cloud is taken apart before surfaces are fitted. */
enum class SegmentationChoice {
  Surfaces, /**< pcl::EntropyRateSegmentation */
  Groups    /**< pcl::ConnectedGroupsSegmentation */
};

/** What the command line of pcd_to_nurbs asks for, checked. */
struct Settings {
  CommonOptions common;
  bool demo = false;
  std::string input;
  std::vector<std::string> outputs;
  std::string labels;
  pcl::nurbs::CloudReadOptions read;
  pcl::CloudOrganizer<pcl::PointXYZ>::Projection projection =
      pcl::CloudOrganizer<pcl::PointXYZ>::AUTO;
  std::optional<pcl::SensorNoise> noise;
  SegmentationChoice segmentation = SegmentationChoice::Surfaces;
  int min_segment = 60;
  pcl::nurbs::ReconstructionOptions reconstruction;
  SurfaceOutputOptions output;
  PictureOptions picture;
  std::map<std::string, std::string>
      words; /**< options that are no numbers, as given */
};

/** Parse the command line.
 * \return settings, or nothing if --help or --version has been answered
 * \throws ToolError(kUsage) or boost::program_options::error naming what is wrong */
std::optional<Settings>
parseSettings(int argc, char** argv);

/** The options as they are in force, for the report. */
nlohmann::json
optionsAsJson(const Settings& settings);

} // namespace pcl_nurbs_tools
