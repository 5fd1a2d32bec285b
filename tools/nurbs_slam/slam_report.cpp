// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "outcome.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace pcl_nurbs_tools {
namespace {

using namespace pcl::nurbs;

nlohmann::json
stagesOf(const std::vector<StageTimes>& stages)
{
  nlohmann::json result = nlohmann::json::object();
  for (const StageTimes& stage : stages)
    result[stage.name] = {{"ms_mean", 1e3 * stage.times.mean()},
                          {"ms_p95", 1e3 * stage.times.percentile(0.95)},
                          {"ms_max", 1e3 * stage.times.max()}};
  return result;
}

const char*
nameOf(Weakness weakness)
{
  switch (weakness) {
  case Weakness::Lost:
    return "lost";
  case Weakness::Degenerate:
    return "degenerate";
  case Weakness::Unreadable:
    break;
  }
  return "unreadable";
}

nlohmann::json
weakOf(const std::vector<WeakInterval>& intervals)
{
  nlohmann::json result = nlohmann::json::array();
  for (const WeakInterval& weak : intervals) {
    result.push_back({{"first_scan", weak.first},
                      {"last_scan", weak.last},
                      {"from_s", weak.from},
                      {"to_s", weak.to},
                      {"reason", nameOf(weak.weakness)}});
    if (weak.weakness == Weakness::Degenerate)
      result.back()["directions"] = weak.directions;
  }
  return result;
}

void
addErrors(nlohmann::json& report, const Outcome& outcome)
{
  constexpr double kDegrees = 180.0 / M_PI;
  const TrajectoryPair& pair = outcome.compared.pair;
  if (pair.reference.empty())
    return;
  const auto rmse = [](const Comparison& comparison) {
    return summarizeErrors(absoluteErrors(comparison.pair).translation).rmse;
  };
  report["ate_rmse_m"] = rmse(outcome.compared);
  report["odometry_ate_rmse_m"] = rmse(outcome.compared_odometry);
  report["ate_alignment"] = outcome.compared.alignment;
  report["truth_distance_m"] = pathLengths(pair.reference).back();
  const KittiErrors kitti = meanErrors(kittiSegments(pair));
  if (kitti.segments == 0)
    return;
  report["kitti_t_percent"] = 100.0 * kitti.translation;
  report["kitti_r_deg_per_m"] = kDegrees * kitti.rotation;
}

} // namespace

nlohmann::json
reportOf(const SlamSettings& settings,
         const ScanSource& source,
         const SlamResult& result,
         const Outcome& outcome)
{
  const double scans = static_cast<double>(result.scans.size());
  nlohmann::json problems = source.problems();
  for (const std::string& fault : result.faults)
    problems.push_back(fault);
  nlohmann::json report = {{"scans", result.scans.size()},
                           {"distance_m", pathLengths(outcome.estimate).back()},
                           {"keyframes", result.keyframes.size()},
                           {"loops", result.loops.size()},
                           {"loop_scans", result.loops},
                           {"held_loop_scans", result.held_loops},
                           {"skipped", result.skipped},
                           {"unreadable", result.faults.size()},
                           {"lost", result.scans.size() - result.tracked - 1},
                           {"weakly_constrained", weakOf(result.weak)},
                           {"stages", stagesOf(result.stages)},
                           {"seconds", result.seconds},
                           {"scans_per_second", scans / result.seconds},
                           {"peak_rss_mb", peakMemoryMegabytes()},
                           {"problems", problems},
                           {"options", settings.options}};
  report["options"]["threads"] = settings.slam.odometry.threads;
  addErrors(report, outcome);
  return report;
}

} // namespace pcl_nurbs_tools
