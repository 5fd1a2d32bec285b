// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Loops of a drive whose odometry drifts by a known amount.

#include "scene_drive.h"

#include <pcl/mapping/keyframe_graph.h>
#include <pcl/mapping/trajectory_metrics.h>
#include <pcl/registration/scan_preprocessing.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** What a drifting odometry says: every motion is turned and stretched a little. */
Trajectory
drifting(const Trajectory& truth, double turn_per_metre, double stretch)
{
  Trajectory result = truth;
  for (std::size_t k = 1; k < truth.size(); ++k) {
    const Eigen::Isometry3d motion =
        truth[k - 1].T_world_body.inverse() * truth[k].T_world_body;
    Tangent error = Tangent::Zero();
    error[0] = stretch * motion.translation().norm();
    error[5] = turn_per_metre * motion.translation().norm();
    result[k].T_world_body = result[k - 1].T_world_body * motion * exponential(error);
  }
  return result;
}

ProximityLoopOptions
loopOptions()
{
  ProximityLoopOptions options;
  options.min_way = 30.0;
  return options;
}

/** A drive of a known trajectory with odometry that drifts. */
struct DriftingDrive {
  Scene scene = street();
  Trajectory truth;
  double turn_per_metre = 2e-3;
  double stretch = 0.005;
  std::size_t lost_from = 0; // scans whose alignment failed
  std::size_t lost_to = 0;

  KeyframeGraph
  run(std::unique_ptr<LoopDetector> detector) const
  {
    KeyframeGraph graph({}, std::move(detector));
    const Trajectory odometry = drifting(truth, turn_per_metre, stretch);
    double since = 0.0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      std::mt19937 random(static_cast<unsigned>(k));
      OdometryResult result;
      result.pose = odometry[0].T_world_body.inverse() * odometry[k].T_world_body;
      result.tracked = !(k >= lost_from && k < lost_to);
      result.match.covariance = 1e-6 * TangentMatrix::Identity();
      if (k > 0)
        since += (truth[k].T_world_body.translation() -
                  truth[k - 1].T_world_body.translation())
                     .norm();
      result.keyframe = k == 0 || (since >= 3.0 && result.tracked);
      since = result.keyframe ? 0.0 : since;
      result.points = finitePoints(*cloudSeenFrom<pcl::PointXYZ>(
          truth[k].T_world_body, sampleScene(scene, 2500, 0.01, random)));
      graph.add(k, truth[k].stamp, result);
    }
    graph.finish();
    return graph;
  }

  double
  error(const Trajectory& estimate) const
  {
    TrajectoryPair pair = associate(truth, estimate);
    pair.estimate =
        transformed(pair.estimate, alignTrajectory(pair, TrajectoryAlignment::SE3));
    return summarizeErrors(absoluteErrors(pair).translation).rmse;
  }

  /** How far a loop is from what is true about its keyframes. */
  Eigen::Isometry3d
  loopError(const KeyframeGraph& graph, const BetweenFactor& loop) const
  {
    const auto pose = [&](NodeId node) {
      return truth[graph.keyframes()[node].scan].T_world_body;
    };
    return loop.T_from_to.inverse() * pose(loop.from).inverse() * pose(loop.to);
  }
};

TEST(KeyframeGraph, aCircuitCloses)
{
  DriftingDrive drive;
  drive.truth = ellipseDrive(250, 0.03); // 1.2 times around
  const KeyframeGraph graph =
      drive.run(std::make_unique<ProximityLoopDetector>(loopOptions()));
  ASSERT_GE(graph.loops().size(), 2U);
  for (const BetweenFactor& loop : graph.loops()) {
    const Eigen::Isometry3d error = drive.loopError(graph, loop);
    EXPECT_LT(error.translation().norm(), 0.1) << loop.from << ' ' << loop.to;
    EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.01);
    EXPECT_LT(loop.from, loop.to);
  }
  const double before = drive.error(graph.odometry());
  const double after = drive.error(graph.trajectory());
  EXPECT_GT(before, 0.2);
  EXPECT_LT(after, 0.35 * before);
  EXPECT_EQ(graph.graph().nodes().size(), graph.keyframes().size());
  EXPECT_EQ(graph.graph().factors().size(),
            graph.keyframes().size() - 1 + graph.loops().size());
}

TEST(KeyframeGraph, scansMoveWithTheirKeyframes)
{
  DriftingDrive drive;
  drive.truth = ellipseDrive(250, 0.03);
  const KeyframeGraph graph =
      drive.run(std::make_unique<ProximityLoopDetector>(loopOptions()));
  const Trajectory after = graph.trajectory();
  const Trajectory before = graph.odometry();
  std::size_t keyframe = 0;
  for (std::size_t k = 0; k < after.size(); ++k) {
    const std::vector<Keyframe>& keyframes = graph.keyframes();
    if (keyframe + 1 < keyframes.size() && keyframes[keyframe + 1].scan == k)
      ++keyframe;
    const Eigen::Isometry3d seen =
        graph.graph().node(keyframes[keyframe].node).T_world_node.inverse() *
        after[k].T_world_body;
    const Eigen::Isometry3d by_odometry =
        keyframes[keyframe].T_odometry_keyframe.inverse() * before[k].T_world_body;
    ASSERT_TRUE(seen.isApprox(by_odometry, 1e-9)) << k;
  }
}

TEST(KeyframeGraph, withoutLoopsOdometryStays)
{
  DriftingDrive drive;
  drive.truth = ellipseDrive(60, 0.03);
  const KeyframeGraph none = drive.run(nullptr);
  const KeyframeGraph unfinished =
      drive.run(std::make_unique<ProximityLoopDetector>(loopOptions()));
  for (const KeyframeGraph* graph : {&none, &unfinished}) {
    EXPECT_TRUE(graph->loops().empty());
    const Trajectory a = graph->odometry();
    const Trajectory b = graph->trajectory();
    for (std::size_t k = 0; k < a.size(); ++k)
      ASSERT_TRUE(a[k].T_world_body.isApprox(b[k].T_world_body, 1e-9));
  }
}

TEST(KeyframeGraph, aPlaceThatCannotBeToldApartIsNoLoop)
{
  // Along a corridor without features the sensor may be anywhere.
  DriftingDrive drive;
  drive.scene = corridor();
  for (std::size_t k = 0; k < 120; ++k) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().x() = 8.0 * std::sin(0.08 * static_cast<double>(k));
    drive.truth.push_back({0.1 * static_cast<double>(k), pose});
  }
  const KeyframeGraph graph =
      drive.run(std::make_unique<ProximityLoopDetector>(loopOptions()));
  EXPECT_TRUE(graph.loops().empty());
}

TEST(KeyframeGraph, aLostStretchTakesTheCorrection)
{
  DriftingDrive drive;
  drive.truth = ellipseDrive(250, 0.03);
  drive.stretch = 0.0;
  drive.turn_per_metre = 0.0;
  drive.lost_from = 100;
  drive.lost_to = 104;
  const KeyframeGraph graph = drive.run(nullptr);
  std::size_t loosest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [id, factor] : graph.graph().factors()) {
    const auto& between = std::get<BetweenFactor>(factor.measurement);
    if (between.information.trace() < least) {
      least = between.information.trace();
      loosest = between.from;
    }
  }
  EXPECT_LE(graph.keyframes()[loosest].scan, 100U);
  EXPECT_GE(graph.keyframes()[loosest + 1].scan, 103U);
}

/** Another detector, as a user would write one. */
class NamedLoop : public LoopDetector {
public:
  std::vector<BetweenFactor>
  detect(const std::vector<Keyframe>& keyframes, const PoseGraph& graph) override
  {
    if (keyframes.size() != 4)
      return {};
    const Eigen::Isometry3d measured = graph.node(0).T_world_node.inverse() *
                                       graph.node(3).T_world_node *
                                       Eigen::Translation3d(0.3, 0.0, 0.0);
    return {{0, 3, measured, 1e8 * TangentMatrix::Identity()}};
  }
};

TEST(KeyframeGraph, aDetectorOfOnesOwn)
{
  DriftingDrive drive;
  drive.truth = ellipseDrive(60, 0.03);
  const KeyframeGraph graph = drive.run(std::make_unique<NamedLoop>());
  ASSERT_EQ(graph.loops().size(), 1U);
  const Eigen::Isometry3d moved = graph.keyframes()[3].T_odometry_keyframe.inverse() *
                                  graph.graph().node(3).T_world_node;
  EXPECT_NEAR(moved.translation().norm(), 0.3, 0.05);
}

/** Finds what the other one finds, and claims now and then that a place a few metres
 * off is the same. */
class SometimesWrong : public ProximityLoopDetector {
public:
  explicit SometimesWrong(const ProximityLoopOptions& options)
      : ProximityLoopDetector(options)
  {
  }

  std::vector<BetweenFactor>
  detect(const std::vector<Keyframe>& keyframes, const PoseGraph& graph) override
  {
    std::vector<BetweenFactor> found = ProximityLoopDetector::detect(keyframes, graph);
    const std::size_t last = keyframes.size() - 1;
    if (last % 12 != 11)
      return found;
    BetweenFactor wrong{last / 3, last, Eigen::Isometry3d::Identity(), {}};
    wrong.T_from_to = graph.node(wrong.from).T_world_node.inverse() *
                      graph.node(wrong.to).T_world_node *
                      Eigen::Translation3d(0.0, 12.0, 0.5 * static_cast<double>(last));
    wrong.information = 1e4 * TangentMatrix::Identity();
    found.push_back(wrong);
    return found;
  }
};

TEST(KeyframeGraph, aFalseLoopDoesNotBendTheTrajectory)
{
  DriftingDrive drive;
  drive.truth = ellipseDrive(250, 0.03);
  const KeyframeGraph right =
      drive.run(std::make_unique<ProximityLoopDetector>(loopOptions()));
  const KeyframeGraph misled =
      drive.run(std::make_unique<SometimesWrong>(loopOptions()));
  EXPECT_GE(misled.heldLoops().size(), 1U);
  EXPECT_EQ(misled.loops().size(), right.loops().size());
  for (const HeldLoop& held : misled.heldLoops())
    EXPECT_GT(drive.loopError(misled, held.loop).translation().norm(), 5.0);
  EXPECT_NEAR(drive.error(misled.trajectory()), drive.error(right.trajectory()), 1e-3);
}

TEST(KeyframeGraph, refusesOptionsThatMakeNoSense)
{
  KeyframeGraphOptions options;
  options.point_spacing = 0.0;
  EXPECT_THROW(KeyframeGraph(options, nullptr), std::invalid_argument);
  options = {};
  options.drift_rotation = -1.0;
  EXPECT_THROW(KeyframeGraph(options, nullptr), std::invalid_argument);
}

} // namespace
