// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// simulate_scans: a drive through a made-up town, as a data set with exact truth.

#include "progress_bar.h"
#include "run_tool.h"
#include "settings.h"

#include <pcl/mapping/stop_watch.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <vector>

namespace pcl_nurbs_tools {
namespace {

using namespace pcl::nurbs;

/** Figures of a run. */
struct Outcome {
  std::size_t scans = 0;
  double distance = 0.0;
  std::uint32_t surfaces = 0;
  double build_seconds = 0.0;
  double scan_seconds = 0.0;
};

/** Scans of another run beside those to come would belong to other poses. */
void
clearScans(const SimulationSettings& settings)
{
  using std::filesystem::path;
  const bool camera = settings.sensor == "kinect";
  const path root = settings.out;
  const path sequence = root / "sequences" / settings.writing.sequence;
  const std::vector<path> folders = camera
                                        ? std::vector<path>{root / "depth"}
                                        : std::vector<path>{sequence / "velodyne",
                                                            sequence / "labels",
                                                            sequence / "point_times"};
  for (const path& folder : folders) {
    std::error_code error;
    if (!std::filesystem::exists(folder, error) ||
        std::filesystem::is_empty(folder, error) || error)
      continue;
    if (!settings.overwrite)
      throw ToolError(kUsage,
                      folder.string() + " holds scans already (see --overwrite)");
    std::filesystem::remove_all(folder, error);
    if (error)
      throw ToolError(kCannotWrite,
                      "cannot write " + folder.string() + ": " + error.message());
  }
}

std::size_t
write(const SimulatedDrive& drive, SimulationSettings& settings)
{
  const std::size_t left =
      drive.size() - std::min(drive.size(), settings.writing.first);
  const std::size_t asked =
      settings.writing.count > 0 ? std::min(settings.writing.count, left) : left;
  if (asked == 0)
    throw ToolError(
        kUsage, "--first: the drive has " + std::to_string(drive.size()) + " scans");
  ProgressBar bar("simulating", settings.common.quiet);
  settings.writing.progress = [&](std::size_t done) {
    bar.update(static_cast<double>(done) / static_cast<double>(asked));
    return !interrupted();
  };
  try {
    return settings.sensor == "kinect"
               ? writeTumDrive(drive, settings.out, settings.writing)
               : writeKittiDrive(drive, settings.out, settings.writing);
  } catch (const std::runtime_error& error) {
    throw ToolError(kCannotWrite, error.what());
  }
}

void
report(const SimulationSettings& settings, const Outcome& outcome)
{
  if (!settings.common.report.empty()) {
    const nlohmann::json figures = {
        {"scans", outcome.scans},
        {"distance_m", outcome.distance},
        {"surfaces", outcome.surfaces},
        {"scans_per_second", static_cast<double>(outcome.scans) / outcome.scan_seconds},
        {"seconds",
         {{"build", outcome.build_seconds}, {"scans", outcome.scan_seconds}}},
        {"peak_rss_mb", peakMemoryMegabytes()},
        {"options",
         {{"sensor", settings.sensor},
          {"seed", settings.simulation.town.seed},
          {"distortion", settings.simulation.motion_distortion},
          {"exact", settings.exact}}}};
    writeText(settings.common.report, figures.dump(2) + '\n');
  }
  if (!settings.common.quiet)
    std::printf("%zu scans, %.1f m, %u surfaces: %s (%.1f scans/s)\n",
                outcome.scans,
                outcome.distance,
                outcome.surfaces,
                settings.out.c_str(),
                static_cast<double>(outcome.scans) / outcome.scan_seconds);
}

void
simulate(int argc, char** argv)
{
  SimulationSettings settings;
  if (!parseSettings(argc, argv, settings))
    return;
  clearScans(settings);
  StopWatch watch;
  const SimulatedDrive drive(
      driveOf(settings), sensorOf(settings), settings.simulation);
  Outcome outcome;
  outcome.build_seconds = watch.lap();
  outcome.surfaces = drive.town().numSurfaces();
  outcome.scans = write(drive, settings);
  outcome.scan_seconds = watch.lap();
  const std::vector<double> path = pathLengths(*drive.truth());
  outcome.distance =
      path[settings.writing.first + outcome.scans - 1] - path[settings.writing.first];
  report(settings, outcome);
  throwIfInterrupted();
}

} // namespace
} // namespace pcl_nurbs_tools

int
main(int argc, char** argv)
{
  using namespace pcl_nurbs_tools;
  return runTool("simulate_scans", [&] { simulate(argc, argv); });
}
