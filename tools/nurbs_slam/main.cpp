// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// nurbs_slam: a drive of a range sensor becomes a trajectory.

#include "outcome.h"
#include "progress_bar.h"
#include "run_tool.h"
#include "settings.h"

#include <pcl/mapping/cloud_reader.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>

namespace pcl_nurbs_tools {
namespace {

using namespace pcl::nurbs;

void
makeFolder(const std::string& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && !std::filesystem::is_directory(folder, error))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw ToolError(kCannotWrite, "cannot write " + folder + ": " + error.message());
}

/** Run something; errors of options become those of usage. */
template <typename Make>
auto
withUsage(const Make& make)
{
  try {
    return make();
  } catch (const std::invalid_argument& problem) {
    throw ToolError(kUsage, problem.what());
  }
}

void
print(const SlamSettings& settings, const nlohmann::json& report)
{
  std::printf("%zu scans, %.1f m, %zu keyframes, %zu loops",
              report["scans"].get<std::size_t>(),
              report["distance_m"].get<double>(),
              report["keyframes"].get<std::size_t>(),
              report["loops"].get<std::size_t>());
  for (const char* count : {"skipped", "unreadable", "lost"})
    if (report[count].get<std::size_t>() > 0)
      std::printf(", %zu %s", report[count].get<std::size_t>(), count);
  std::printf(" (%.1f scans/s)\n", report["scans_per_second"].get<double>());
  if (report.contains("ate_rmse_m"))
    std::printf("absolute error %.3f m rms (odometry alone %.3f m)",
                report["ate_rmse_m"].get<double>(),
                report["odometry_ate_rmse_m"].get<double>());
  if (report.contains("kitti_t_percent"))
    std::printf(", KITTI %.3f %%, %.5f deg/m",
                report["kitti_t_percent"].get<double>(),
                report["kitti_r_deg_per_m"].get<double>());
  if (report.contains("ate_rmse_m"))
    std::printf("\n");
  const std::size_t weak = report["weakly_constrained"].size();
  if (weak > 0)
    std::printf("weakly constrained in %zu intervals (see report.json)\n", weak);
  for (const nlohmann::json& problem : report["problems"])
    std::printf("left out: %s\n", problem.get<std::string>().c_str());
  std::printf("wrote trajectory_kitti.txt, trajectory_tum.txt, trajectory.png, "
              "pose_graph.g2o and report.json to %s\n",
              settings.out.c_str());
}

/** Write what was done. \return its report; null where there is nothing */
nlohmann::json
finish(const SlamSettings& settings,
       const ScanSource& source,
       const SlamPipeline& pipeline)
{
  const SlamResult& result = pipeline.result();
  if (result.keyframes.empty())
    return nullptr;
  const Outcome outcome = outcomeOf(settings, source, result);
  const nlohmann::json report = reportOf(settings, source, result, outcome);
  writeOutcome(settings, pipeline.keyframeGraph().graph(), report, outcome);
  return report;
}

/** Write what was done before a drive ended early. \return what to say of it */
std::string
finishEarly(const SlamSettings& settings,
            const ScanSource& source,
            const SlamPipeline& pipeline)
{
  const nlohmann::json report = finish(settings, source, pipeline);
  if (report.is_null())
    return "; no scan was done before";
  return "; the " + std::to_string(pipeline.result().scans.size()) +
         " scans done before are in " + settings.out;
}

/** Whether nothing was made of several scans, or of a single one without points. */
bool
lostAtTheStart(const SlamResult& result)
{
  return result.keyframes.empty() || (result.scans.size() > 1 && result.tracked == 0);
}

void
run(int argc, char** argv)
{
  const std::optional<SlamSettings> parsed = parseSlamSettings(argc, argv);
  if (!parsed)
    return;
  const SlamSettings& settings = *parsed;
  const std::unique_ptr<ScanSource> source =
      withUsage([&] { return openDataset(settings); });
  const std::unique_ptr<SlamPipeline> pipeline =
      withUsage([&] { return std::make_unique<SlamPipeline>(*source, settings.slam); });
  makeFolder(settings.out);
  {
    ProgressBar bar("tracking", settings.common.quiet);
    pipeline->setProgress([&](std::size_t done, std::size_t all) {
      bar.update(static_cast<double>(done) / static_cast<double>(all));
      return !interrupted();
    });
    try {
      pipeline->run();
    } catch (const InputError& error) {
      throw ToolError(kBadInput,
                      error.what() + finishEarly(settings, *source, *pipeline));
    }
  }
  const SlamResult& result = pipeline->result();
  if (interrupted())
    throw ToolError(kInterrupted,
                    "interrupted" + finishEarly(settings, *source, *pipeline));
  if (lostAtTheStart(result))
    throw ToolError(kNothingProduced,
                    "tracking was lost at the start: no scan could be aligned with the "
                    "one before");
  const nlohmann::json report = finish(settings, *source, *pipeline);
  if (!settings.common.quiet)
    print(settings, report);
}

} // namespace
} // namespace pcl_nurbs_tools

int
main(int argc, char** argv)
{
  return pcl_nurbs_tools::runTool("nurbs_slam",
                                  [&] { pcl_nurbs_tools::run(argc, argv); });
}
