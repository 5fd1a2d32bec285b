// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "outcome.h"

#include "path_plot.h"
#include "run_tool.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <stdexcept>

namespace pcl_nurbs_tools {
namespace {

using namespace pcl::nurbs;

/** Poses of the sensor as poses of the body that the data set's poses are of. */
Trajectory
inDatasetFrame(Trajectory trajectory, const Eigen::Isometry3d& T_body_sensor)
{
  const Eigen::Isometry3d back = T_body_sensor.inverse();
  for (StampedPose& pose : trajectory)
    pose.T_world_body = T_body_sensor * pose.T_world_body * back;
  return trajectory;
}

/** Pairs of poses, the estimate moved so that the first ones agree. */
TrajectoryPair
alignedByFirst(TrajectoryPair pair)
{
  const Eigen::Isometry3d move = pair.reference.front().T_world_body *
                                 pair.estimate.front().T_world_body.inverse();
  for (StampedPose& pose : pair.estimate)
    pose.T_world_body = move * pose.T_world_body;
  return pair;
}

void
compare(Outcome& outcome)
{
  constexpr double kSameTime = 1e-6;
  const TrajectoryPair pair = associate(outcome.truth, outcome.estimate, kSameTime);
  if (pair.reference.empty())
    return;
  try {
    const SimilarityTransform move = alignTrajectory(pair, TrajectoryAlignment::SE3);
    outcome.compared = {pair.reference, transformed(pair.estimate, move)};
    outcome.alignment = "se3";
  } catch (const std::invalid_argument&) { // too few poses, or all on a line
    outcome.compared = alignedByFirst(pair);
    outcome.alignment = "first pose";
  }
}

void
writePicture(const std::string& path, const Outcome& outcome)
{
  if (outcome.compared.reference.empty())
    writePlot(path, pathPlot({{"estimate", outcome.estimate}}));
  else
    writePlot(path,
              pathPlot({{"truth", outcome.compared.reference},
                        {"estimate", outcome.compared.estimate}}));
}

} // namespace

Outcome
outcomeOf(const SlamSettings& settings,
          const ScanSource& source,
          const SlamResult& result)
{
  Outcome outcome;
  const Eigen::Isometry3d calibration = source.calibration();
  outcome.estimate = inDatasetFrame(result.trajectory, calibration);
  for (std::size_t k = result.scans.front(); k <= result.scans.back();
       k += settings.slam.feed.stride)
    outcome.every_scan.push_back(poseAt(outcome.estimate, source.stamp(k)));
  if (source.truth() != nullptr)
    outcome.truth = inDatasetFrame(*source.truth(), calibration);
  compare(outcome);
  return outcome;
}

void
writeOutcome(const SlamSettings& settings,
             const nlohmann::json& report,
             const Outcome& outcome)
{
  const std::filesystem::path folder = settings.out;
  std::string failure;
  const auto attempt = [&](const std::function<void()>& write) {
    try {
      write();
    } catch (const std::runtime_error& error) {
      if (failure.empty())
        failure = error.what();
    }
  };
  const auto name = [&](const char* file) { return (folder / file).string(); };
  attempt(
      [&] { writeKittiTrajectory(name("trajectory_kitti.txt"), outcome.every_scan); });
  attempt([&] { writeTumTrajectory(name("trajectory_tum.txt"), outcome.estimate); });
  if (!outcome.truth.empty()) {
    attempt([&] { writeKittiTrajectory(name("truth_kitti.txt"), outcome.truth); });
    attempt([&] { writeTumTrajectory(name("truth_tum.txt"), outcome.truth); });
  }
  const std::string text = report.dump(2) + '\n';
  attempt([&] { writeText(name("report.json"), text); });
  if (!settings.common.report.empty())
    attempt([&] { writeText(settings.common.report, text); });
  attempt([&] { writePicture(name("trajectory.png"), outcome); });
  if (!failure.empty())
    throw ToolError(kCannotWrite, failure);
}

} // namespace pcl_nurbs_tools
