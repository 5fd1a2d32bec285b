// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "settings_checks.h"

#include "run_tool.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace pcl_nurbs_tools {
namespace {

void
require(bool met, const std::string& message)
{
  if (!met)
    throw ToolError(kUsage, message);
}

/** Ranges of single options. */
void
validateRanges(const Settings& settings)
{
  const pcl::nurbs::ReconstructionOptions& fit = settings.reconstruction;
  settings.picture.validate();
  require(settings.read.depth_scale > 0.0 && std::isfinite(settings.read.depth_scale),
          "--depth-scale must be above 0");
  require(settings.read.bin_values_per_point == 3 ||
              settings.read.bin_values_per_point == 4,
          "--bin-values must be 3 or 4");
  require(settings.output.mesh_tolerance >= 0.0 &&
              std::isfinite(settings.output.mesh_tolerance),
          "--mesh-tolerance must not be negative");
  require(fit.tolerance >= 0.0 && std::isfinite(fit.tolerance),
          "--tolerance must not be negative");
  require(fit.knots.max_degree >= 1 && fit.knots.max_degree <= pcl::nurbs::kMaxDegree,
          "--max-degree must be 1 to 9");
  require(fit.knots.max_control_points >= 4, "--max-control-points must be at least 4");
  require(fit.knots.points_per_sample == 0.0 ||
              (fit.knots.points_per_sample >= 1.0 &&
               std::isfinite(fit.knots.points_per_sample)),
          "--correlation must be 0 or at least 1");
  require(settings.min_segment >= 1, "--min-segment must be at least 1");
  require(fit.min_patch_points >= 4, "--min-patch must be at least 4");
  require(fit.hold_out_every == 0 || fit.hold_out_every >= 2,
          "--hold-out must be 0 or at least 2");
}

/** The file a path leads to; a path that cannot be followed stands for itself. */
std::string
resolved(const std::string& path)
{
  std::error_code error;
  const auto canonical =
      std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
  return error ? path : canonical.string();
}

/** No file may be named twice, and every extension must be known. */
void
validateFiles(const Settings& settings)
{
  std::set<std::string> names;
  std::vector<std::string> all = settings.outputs;
  for (const std::string* path : {&settings.labels, &settings.common.report})
    if (!path->empty())
      all.push_back(*path);
  for (const std::string& path : all)
    require(names.insert(resolved(path)).second, path + " is named as output twice");
  require(settings.input.empty() || names.count(resolved(settings.input)) == 0,
          settings.input + " is both input and output");
  const std::vector<std::string>& known = surfaceExtensions();
  for (const std::string& path : settings.outputs)
    require(extensionOf(path) == ".png" ||
                std::find(known.begin(), known.end(), extensionOf(path)) != known.end(),
            path + ": unknown extension; .nurbs .json .obj .ply and .png are known");
  require(settings.labels.empty() || extensionOf(settings.labels) == ".pcd",
          settings.labels + ": --labels writes .pcd files");
}

} // namespace

void
checkSettings(const Settings& settings)
{
  validateRanges(settings);
  validateFiles(settings);
}

} // namespace pcl_nurbs_tools
