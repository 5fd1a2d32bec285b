// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Drives that are no matter of course: public routes, places without any hold, standing
// still.

#include "test_data.h"
#include "town_drives.h"

#include <pcl/mapping/kitti_calibration.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

Trajectory
straightDrive(double length, CircuitShape shape = CircuitShape::Line)
{
  CircuitOptions options;
  options.shape = shape;
  options.size = length;
  options.laps = 1.0;
  return makeCircuit(options);
}

SimulatedDrive
exactDrive(TownScene scene, const Trajectory& drive, int columns = 90)
{
  SimulationOptions options;
  options.noise = false;
  options.town.movers = false;
  options.town.scene = scene;
  return SimulatedDrive(drive, coarseLaser(columns), options);
}

/** Nothing is nearer than a metre on the sensor's level, nor between its poses. */
void
expectFreeWay(const Town& town)
{
  const Trajectory& drive = town.drive();
  for (std::size_t k = 0; k < drive.size(); ++k) {
    const Eigen::Vector3d place = drive[k].T_world_body.translation();
    for (const double angle : {0.0, 0.8, 1.6, 2.4, 3.2, 4.0, 4.8, 5.6}) {
      const Beam beam{place, {std::cos(angle), std::sin(angle), 0.0}};
      ASSERT_EQ(town.tree().cast(beam, 0.0, 1.0).surface, BeamHit::kNothing) << k;
    }
    if (k == 0)
      continue;
    const Eigen::Vector3d way = place - drive[k - 1].T_world_body.translation();
    const Beam beam{place - way, way.normalized()};
    if (way.norm() > 1e-3) {
      ASSERT_EQ(town.tree().cast(beam, 0.0, way.norm()).surface, BeamHit::kNothing)
          << k;
    }
    const Beam down{place, -Eigen::Vector3d::UnitZ()};
    const BeamHit ground = town.tree().cast(down, 0.0, 10.0);
    ASSERT_NE(ground.surface, BeamHit::kNothing) << k;
    ASSERT_NEAR(ground.distance, 1.89, 0.45) << k;
  }
}

class PublicRoute : public testing::TestWithParam<const char*> {};

TEST_P(PublicRoute, hasRoomAndAStreet)
{
  const std::string poses = std::string("kitti_odometry/poses/") + GetParam() + ".txt";
  PCL_NURBS_DATA_OR_SKIP(file, poses);
  Trajectory drive = readTrajectory(file.string(), "");
  for (StampedPose& pose : drive)
    pose.stamp *= 0.1;
  expectFreeWay(Town(inLaserFrame(drive, nominalKittiCalibration())));
}

INSTANTIATE_TEST_SUITE_P(KITTI,
                         PublicRoute,
                         testing::Values("00", "01", "03", "04", "06", "07", "08"),
                         [](const testing::TestParamInfo<const char*>& info) {
                           return info.param;
                         });

TEST(SimulatedScenes, circuitsHaveRoom)
{
  for (const CircuitShape shape : {CircuitShape::Block,
                                   CircuitShape::Oval,
                                   CircuitShape::Eight,
                                   CircuitShape::Line})
    for (const TownScene scene :
         {TownScene::Streets, TownScene::Tunnel, TownScene::Square}) {
      CircuitOptions options;
      options.shape = shape;
      TownOptions town;
      town.scene = scene;
      expectFreeWay(Town(makeCircuit(options), town));
    }
}

TEST(SimulatedScenes, aTunnelLooksTheSameEverywhere)
{
  const SimulatedDrive drive = exactDrive(TownScene::Tunnel, straightDrive(300.0));
  const SimulatedScan one = drive.simulate(180);
  const SimulatedScan other = drive.simulate(205);
  EXPECT_TRUE(drive.town().movers().empty());
  int compared = 0;
  for (std::size_t i = 0; i < one.surfaces.size(); ++i) {
    if (one.surfaces[i] == BeamHit::kNothing)
      continue;
    ASSERT_NE(other.surfaces[i], BeamHit::kNothing);
    const auto& here = (*one.scan.cloud)[i].getVector3fMap();
    ASSERT_LT((here - (*other.scan.cloud)[i].getVector3fMap()).norm(), 1e-4) << i;
    ++compared;
  }
  EXPECT_GT(compared, 5000); // of 5760, without the vehicle itself
}

TEST(SimulatedScenes, aSquareIsAPlane)
{
  CircuitOptions hilly;
  const SimulatedDrive drive = exactDrive(TownScene::Square, makeCircuit(hilly));
  EXPECT_EQ(drive.town().numSurfaces(), 1U);
  const double height = drive.truth()->front().T_world_body.translation().z();
  for (const std::size_t k : {0, 100}) {
    EXPECT_EQ((*drive.truth())[k].T_world_body.translation().z(), height);
    int returns = 0;
    for (const Eigen::Vector3d& point : drive.simulate(k).true_points) {
      if (!point.allFinite())
        continue;
      ASSERT_NEAR(point.z(), height - 1.89, 1e-9);
      ++returns;
    }
    EXPECT_GT(returns, 3000);
  }
}

TEST(SimulatedScenes, standingStillSeesTheSame)
{
  const Trajectory still = straightDrive(60.0, CircuitShape::Standstill);
  ASSERT_EQ(still.size(), 76U); // 60 m at 8 m/s, 10 Hz
  EXPECT_EQ(still.back().T_world_body.matrix(), still.front().T_world_body.matrix());
  const SimulatedDrive drive = exactDrive(TownScene::Streets, still);
  const SimulatedScan one = drive.simulate(3);
  const SimulatedScan other = drive.simulate(70);
  EXPECT_EQ(one.surfaces, other.surfaces);
  for (std::size_t i = 0; i < one.surfaces.size(); ++i)
    if (one.surfaces[i] != BeamHit::kNothing) {
      ASSERT_EQ(one.true_points[i], other.true_points[i]);
    }
}

TEST(SimulatedScenes, onePoseIsEnough)
{
  const SimulatedDrive one(Trajectory(1), coarseLaser(200));
  const Scan scan = one.read(0);
  int returns = 0;
  for (const pcl::PointXYZI& point : *scan.cloud)
    returns += std::isfinite(point.x) ? 1 : 0;
  EXPECT_GT(returns, 5000);
}

} // namespace
