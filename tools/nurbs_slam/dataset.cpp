// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "run_tool.h"
#include "settings.h"

#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>

namespace pcl_nurbs_tools {
namespace {

using namespace pcl::nurbs;

std::unique_ptr<ScanSource>
simulate(const SlamSettings& s)
{
  SimulationOptions options = s.simulation;
  options.noise = !s.exact;
  options.town.sensor_height = s.drive.sensor_height;
  options.town.scene = sceneOf(s.drive);
  options.T_body_sensor = mountOf(s.drive);
  return std::make_unique<SimulatedDrive>(driveOf(s.drive), sensorOf(s.drive), options);
}

} // namespace

std::string
layoutOf(const SlamSettings& settings)
{
  if (settings.dataset != "auto" && settings.dataset != "kitti")
    return settings.dataset;
  const std::filesystem::path folder = settings.path;
  std::error_code error;
  const auto has = [&](const char* name) {
    return std::filesystem::exists(folder / name, error);
  };
  if (has("velodyne_points"))
    return "kitti_raw";
  if (settings.dataset == "kitti" || has("sequences"))
    return "kitti";
  if (isDepthFolder(settings.path))
    return "tum";
  return "files";
}

std::unique_ptr<ScanSource>
openDataset(const SlamSettings& s)
{
  if (s.dataset != "sim" && s.path.empty())
    throw ToolError(kUsage, "--path is needed (see --help)");
  if (s.dataset == "sim")
    return simulate(s);
  if (s.dataset == "kitti")
    return openKittiOdometry(s.path, s.sequence, s.reading);
  if (s.dataset == "kitti_raw")
    return openKittiRaw(s.path, s.reading);
  if (s.dataset == "tum")
    return openDepthSequence(s.path, s.reading);
  if (s.dataset == "files")
    return openCloudFolder(s.path, s.reading);
  throw ToolError(kUsage, "dataset must be kitti, kitti_raw, tum, files, sim or auto");
}

} // namespace pcl_nurbs_tools
