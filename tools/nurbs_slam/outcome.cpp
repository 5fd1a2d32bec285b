// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "outcome.h"

#include "path_plot.h"
#include "run_tool.h"

#include <pcl/mapping/pose_graph_io.h>

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

Comparison
compare(const Trajectory& truth, const Trajectory& estimate)
{
  constexpr double kSameTime = 1e-6;
  const TrajectoryPair pair = associate(truth, estimate, kSameTime);
  if (pair.reference.empty())
    return {};
  try {
    const SimilarityTransform move = alignTrajectory(pair, TrajectoryAlignment::SE3);
    return {{pair.reference, transformed(pair.estimate, move)}, "se3"};
  } catch (const std::invalid_argument&) { // too few poses, or all on a line
    return {alignedByFirst(pair), "first pose"};
  }
}

/** Path of the drive; that of odometry only where the graph changed it. */
void
writePicture(const std::string& path, const Outcome& outcome)
{
  const bool compared = !outcome.compared.pair.reference.empty();
  std::vector<std::pair<std::string, Trajectory>> paths;
  if (compared)
    paths.emplace_back("truth", outcome.compared.pair.reference);
  paths.emplace_back("estimate",
                     compared ? outcome.compared.pair.estimate : outcome.estimate);
  if (!outcome.estimate.back().T_world_body.isApprox(
          outcome.odometry.back().T_world_body))
    paths.emplace_back("odometry alone",
                       compared ? outcome.compared_odometry.pair.estimate
                                : outcome.odometry);
  writePlot(path, pathPlot(paths));
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
  outcome.odometry = inDatasetFrame(result.odometry, calibration);
  for (std::size_t k = result.scans.front(); k <= result.scans.back();
       k += settings.slam.feed.stride)
    outcome.every_scan.push_back(poseAt(outcome.estimate, source.stamp(k)));
  if (source.truth() != nullptr)
    outcome.truth = inDatasetFrame(*source.truth(), calibration);
  outcome.compared = compare(outcome.truth, outcome.estimate);
  outcome.compared_odometry = compare(outcome.truth, outcome.odometry);
  return outcome;
}

void
writeOutcome(const SlamSettings& settings,
             const PoseGraph& graph,
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
  attempt([&] { writeG2o(name("pose_graph.g2o"), graph); });
  const std::string text = report.dump(2) + '\n';
  attempt([&] { writeText(name("report.json"), text); });
  if (!settings.common.report.empty())
    attempt([&] { writeText(settings.common.report, text); });
  attempt([&] { writePicture(name("trajectory.png"), outcome); });
  if (!failure.empty())
    throw ToolError(kCannotWrite, failure);
}

} // namespace pcl_nurbs_tools
