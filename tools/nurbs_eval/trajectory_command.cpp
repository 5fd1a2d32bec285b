// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "trajectory_command.h"

#include "path_plot.h"
#include "run_tool.h"
#include "trajectory_settings.h"

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/trajectory_metrics.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace pcl_nurbs_tools {
namespace {

using namespace pcl::nurbs;

constexpr double kDegrees = 180.0 / M_PI;

nlohmann::json
toJson(const ErrorStatistics& statistics, double scale = 1.0)
{
  return {{"rmse", scale * statistics.rmse},
          {"mean", scale * statistics.mean},
          {"median", scale * statistics.median},
          {"std", scale * statistics.std},
          {"min", scale * statistics.min},
          {"max", scale * statistics.max},
          {"sse", scale * scale * statistics.sse}};
}

/** Everything that is measured. */
struct Evaluation {
  TrajectoryPair pair; /**< aligned */
  SimilarityTransform alignment;
  PoseErrors absolute;
  PoseErrors relative;
  std::vector<KittiSegment> segments;
};

Evaluation
evaluate(const TrajectorySettings& settings)
{
  const Trajectory reference =
      readTrajectory(settings.reference, settings.reference_times);
  const Trajectory estimate =
      readTrajectory(settings.estimate, settings.estimate_times);
  Evaluation result;
  TrajectoryPair pair = associate(reference, estimate, settings.max_difference);
  if (pair.reference.empty())
    throw InputError(settings.estimate, "no pose has a time of " + settings.reference);
  try {
    result.alignment = alignTrajectory(pair, settings.alignment);
  } catch (const std::invalid_argument&) {
    throw InputError(settings.estimate,
                     "fewer than three poses to compare, or all on a line: use --align "
                     "none");
  }
  // Motions are compared as they are, but for the scale of a single camera.
  result.pair = {pair.reference, transformed(pair.estimate, result.alignment)};
  result.absolute = absoluteErrors(result.pair);
  result.relative = relativeErrors(result.pair, settings.step, settings.unit);
  result.segments = kittiSegments(result.pair);
  return result;
}

nlohmann::json
reportOf(const TrajectorySettings& settings, const Evaluation& evaluation)
{
  const KittiErrors kitti = meanErrors(evaluation.segments);
  nlohmann::json report = {
      {"poses", evaluation.pair.reference.size()},
      {"length_m", pathLengths(evaluation.pair.reference).back()},
      {"align", settings.align_word},
      {"scale", evaluation.alignment.scale},
      {"ape_m", toJson(summarizeErrors(evaluation.absolute.translation))},
      {"ape_deg", toJson(summarizeErrors(evaluation.absolute.rotation), kDegrees)},
      {"ate_rmse_m", summarizeErrors(evaluation.absolute.translation).rmse},
      {"rpe_step", settings.step_word},
      {"rpe_m", toJson(summarizeErrors(evaluation.relative.translation))},
      {"rpe_deg", toJson(summarizeErrors(evaluation.relative.rotation), kDegrees)},
      {"kitti_segments", kitti.segments}};
  if (kitti.segments > 0) {
    report["kitti_t_percent"] = 100.0 * kitti.translation;
    report["kitti_r_deg_per_m"] = kDegrees * kitti.rotation;
  }
  return report;
}

void
print(const TrajectorySettings& settings, const nlohmann::json& report)
{
  const auto figure = [&](const char* group, const char* name) {
    return report.at(group).at(name).get<double>();
  };
  std::printf("%zu poses compared, %.1f m, aligned: %s",
              report["poses"].get<std::size_t>(),
              report["length_m"].get<double>(),
              settings.align_word.c_str());
  if (settings.alignment == TrajectoryAlignment::Sim3)
    std::printf(" (scale %.6f)", report["scale"].get<double>());
  std::printf("\n%-24s %12s %12s %12s %12s\n", "", "rmse", "mean", "median", "max");
  const auto row = [&](const std::string& name, const char* group) {
    std::printf("%-24s %12.6f %12.6f %12.6f %12.6f\n",
                name.c_str(),
                figure(group, "rmse"),
                figure(group, "mean"),
                figure(group, "median"),
                figure(group, "max"));
  };
  row("absolute (m)", "ape_m");
  row("absolute (deg)", "ape_deg");
  row("over " + settings.step_word + " (m)", "rpe_m");
  row("over " + settings.step_word + " (deg)", "rpe_deg");
  if (report.contains("kitti_t_percent"))
    std::printf("KITTI, 100 to 800 m: %.6f %%, %.6f deg/100 m (%zu segments)\n",
                report["kitti_t_percent"].get<double>(),
                100.0 * report["kitti_r_deg_per_m"].get<double>(),
                report["kitti_segments"].get<std::size_t>());
  else
    std::printf("KITTI: the drive is shorter than 100 m\n");
}

LinePlot
errorPlot(const Evaluation& evaluation)
{
  LinePlot plot{"Absolute error", "path (m)", "error (m)", false, {{"", {}}}};
  const std::vector<double> path = pathLengths(evaluation.pair.reference);
  for (std::size_t k = 0; k < path.size(); ++k)
    plot.lines[0].points.emplace_back(path[k], evaluation.absolute.translation[k]);
  return plot;
}

LinePlot
segmentPlot(const Evaluation& evaluation)
{
  LinePlot plot{"Relative error over segments",
                "length (m)",
                "error (% of the length; 0.01 deg/m)",
                false,
                {{"translation", {}}, {"rotation", {}}}};
  for (int hundreds = 1; hundreds <= 8; ++hundreds) {
    const double length = 100.0 * hundreds;
    const KittiErrors errors = meanErrors(evaluation.segments, length);
    if (errors.segments == 0)
      continue;
    plot.lines[0].points.emplace_back(length, 100.0 * errors.translation);
    plot.lines[1].points.emplace_back(length, 100.0 * kDegrees * errors.rotation);
  }
  return plot;
}

void
writePlots(const std::filesystem::path& folder, const Evaluation& evaluation)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw ToolError(kCannotWrite,
                    "cannot write " + folder.string() + ": " + error.message());
  writePlot((folder / "path.png").string(),
            pathPlot({{"reference", evaluation.pair.reference},
                      {"estimate", evaluation.pair.estimate}}));
  writePlot((folder / "errors.png").string(), errorPlot(evaluation));
  if (!evaluation.segments.empty())
    writePlot((folder / "segments.png").string(), segmentPlot(evaluation));
}

} // namespace

void
evaluateTrajectory(int argc, char** argv)
{
  const std::optional<TrajectorySettings> parsed = parseTrajectorySettings(argc, argv);
  if (!parsed)
    return;
  const TrajectorySettings& settings = *parsed;
  const Evaluation evaluation = evaluate(settings);
  const nlohmann::json report = reportOf(settings, evaluation);
  if (!settings.common.report.empty())
    writeText(settings.common.report, report.dump(2) + '\n');
  if (!settings.plots.empty())
    writePlots(settings.plots, evaluation);
  if (!settings.common.quiet)
    print(settings, report);
}

} // namespace pcl_nurbs_tools
