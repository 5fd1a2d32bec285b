// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "settings.h"

#include "command_line.h"
#include "run_tool.h"
#include "settings_entries.h"

#include <boost/program_options.hpp>

#include <iostream>
#include <map>
#include <stdexcept>

namespace pcl_nurbs_tools {
namespace {

namespace po = boost::program_options;
using namespace pcl::nurbs;

/** What the command line says. */
struct CommandLine {
  std::vector<GivenSetting> given;
  std::string config;
  bool dump = false;
};

bool
parse(int argc, char** argv, SlamSettings& settings, CommandLine& line)
{
  const SettingsTable table = settingsTable(settings);
  po::options_description options("Options");
  addCommonOptions(settings.common, options);
  options.add_options()("config",
                        po::value(&line.config)->value_name("FILE.yaml"),
                        "take settings from a file; options given here come first")(
      "dump-config",
      po::bool_switch(&line.dump),
      "print all settings as such a file and end");
  po::options_description drive("Data set and drive");
  po::options_description odometry("Odometry (defaults are the lidar preset's)");
  po::options_description loops("Loops and pose graph");
  po::options_description simulation("Simulated drive (--dataset sim)");
  table.describe("", drive, line.given);
  table.describe("odometry", odometry, line.given);
  table.describe("loops", loops, line.given);
  table.describe("graph", loops, line.given);
  table.describe("sim", simulation, line.given);
  options.add(drive).add(odometry).add(loops).add(simulation);
  const CommandTexts texts{
      "nurbs_slam",
      "nurbs_slam --dataset kitti|kitti_raw|tum|files|sim --path DIR --out DIR\n"
      "A drive of a range sensor becomes a trajectory; loops are closed.\n",
      "\nWrites to the folder of --out: trajectory_kitti.txt, trajectory_tum.txt,\n"
      "trajectory.png, pose_graph.g2o, report.json; and truth_kitti.txt, truth_tum.txt "
      "if the data "
      "set\n"
      "has true poses.\n"
      "Exit codes: 0 done, 1 wrong usage, 2 input unreadable or invalid, 3 tracking "
      "lost\n"
      "at the start, 4 output could not be written, 130 interrupted (what was done is\n"
      "written).\n"};
  return parseCommandLine(argc, argv, texts, options, nullptr);
}

void
apply(SlamSettings& settings,
      const CommandLine& line,
      const std::vector<GivenSetting>& from_file)
{
  const SettingsTable table = settingsTable(settings);
  applySettings(table, line.config, from_file);
  for (const GivenSetting& given : line.given) {
    try {
      table.set(given);
    } catch (const std::invalid_argument& problem) {
      throw ToolError(kUsage, problem.what());
    }
  }
}

bool
isDepthCamera(const SlamSettings& s)
{
  static const std::map<std::string, bool> presets = {{"lidar", false}, {"rgbd", true}};
  const auto preset = presets.find(s.preset);
  if (preset != presets.end())
    return preset->second;
  if (s.preset != "auto")
    throw ToolError(kUsage, "preset must be lidar, rgbd or auto");
  return s.dataset == "tum" || (s.dataset == "sim" && s.drive.sensor == "kinect");
}

/** Depth cameras in rooms: everything is smaller. */
void
usePresetForRooms(SlamOptions& slam)
{
  slam.odometry = OdometryOptions::rgbd();
  slam.graph.point_spacing = slam.odometry.match_spacing;
  slam.loops.voxel_size = slam.odometry.map.voxel_size;
  slam.loops.min_way = 4.0;
  slam.loops.min_reach = 0.5;
  slam.loops.max_reach = 1.0;
  slam.loops.max_cycle_distance = 0.05;
  slam.loops.min_sigma_translation = 0.005;
}

void
interpretTiming(SlamSettings& s)
{
  static const std::map<std::string, PointTiming> words = {
      {"none", PointTiming::None},
      {"source", PointTiming::Source},
      {"azimuth", PointTiming::Azimuth},
      // Scans of KITTI's benchmark come deskewed, those of its raw data do not.
      {"auto", s.dataset == "kitti_raw" ? PointTiming::Azimuth : PointTiming::Source}};
  const auto found = words.find(s.timing);
  if (found == words.end())
    throw ToolError(kUsage, "timing must be none, azimuth, source or auto");
  s.slam.feed.timing = found->second;
}

void
interpretIntrinsics(SlamSettings& s)
{
  if (s.intrinsics.empty())
    return;
  pcl::PinholeIntrinsics camera;
  int used = 0;
  const int numbers = std::sscanf(s.intrinsics.c_str(),
                                  "%lf,%lf,%lf,%lf%n",
                                  &camera.fx,
                                  &camera.fy,
                                  &camera.cx,
                                  &camera.cy,
                                  &used);
  if (numbers != 4 || static_cast<std::size_t>(used) != s.intrinsics.size() ||
      camera.fx == 0.0 || camera.fy == 0.0)
    throw ToolError(kUsage, "intrinsics must be fx,fy,cx,cy");
  s.reading.cloud.intrinsics = camera;
}

void
requireSensible(const SlamSettings& s)
{
  if (s.out.empty())
    throw ToolError(kUsage, "--out is needed (see --help)");
  if (s.deterministic && s.slam.feed.realtime)
    throw ToolError(kUsage,
                    "deterministic and realtime exclude each other: the clock decides "
                    "which scans are skipped");
}

} // namespace

std::optional<SlamSettings>
parseSlamSettings(int argc, char** argv)
{
  SlamSettings settings;
  CommandLine line;
  if (!parse(argc, argv, settings, line))
    return std::nullopt;
  const std::vector<GivenSetting> from_file =
      line.config.empty() ? std::vector<GivenSetting>() : readSettings(line.config);
  apply(settings, line, from_file);
  if (!line.dump)
    settings.dataset = layoutOf(settings);
  const std::string dataset = settings.dataset;
  if (isDepthCamera(settings))
    usePresetForRooms(settings.slam);
  apply(settings, line, from_file); // over the preset
  if (line.dump) {
    std::cout << settingsTable(settings).yaml();
    return std::nullopt;
  }
  settings.dataset = dataset;
  settings.options = settingsTable(settings).json();
  interpretTiming(settings);
  interpretIntrinsics(settings);
  requireSensible(settings);
  settings.reading.skip_faults = settings.slam.feed.skip_faults;
  const int threads = resolveThreads(settings.common.threads);
  settings.slam.odometry.threads = settings.simulation.threads = threads;
  settings.slam.loops.threads = threads;
  return settings;
}

} // namespace pcl_nurbs_tools
