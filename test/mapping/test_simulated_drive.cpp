// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Drives through the simulated town against what is true about them.

#include "town_drives.h"

#include <pcl/surface/nurbs/closest_point.h>

#include <gtest/gtest.h>

#include <cstring>
#include <map>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

bool
sameBytes(const SimulatedScan& one, const SimulatedScan& other)
{
  const std::size_t size = one.scan.cloud->size();
  return other.scan.cloud->size() == size && one.surfaces == other.surfaces &&
         one.scan.point_times == other.scan.point_times &&
         std::memcmp(one.scan.cloud->points.data(),
                     other.scan.cloud->points.data(),
                     size * sizeof(pcl::PointXYZI)) == 0 &&
         std::memcmp(one.true_points.data(),
                     other.true_points.data(),
                     size * sizeof(Eigen::Vector3d)) == 0;
}

/** Distance of a point, in the world at a time, from a surface of the town. */
double
distanceFrom(const Town& town,
             std::uint32_t surface,
             const Eigen::Vector3d& point,
             double time)
{
  const auto body = town.bodyPose(surface, time);
  if (!body)
    return 1e9;
  return ClosestPointFinder(toNurbs(town.primitive(surface)))
      .find(body->inverse() * point)
      .distance;
}

TEST(SimulatedDrive, sameSeedSameBytesForAnyThreads)
{
  SimulationOptions options;
  options.motion_distortion = true;
  options.threads = 1;
  const SimulatedScan one = townDrive(options).simulate(30);
  options.threads = 3;
  EXPECT_TRUE(sameBytes(one, townDrive(options).simulate(30)));
  options.town.seed = 2;
  EXPECT_FALSE(sameBytes(one, townDrive(options).simulate(30)));
}

TEST(SimulatedDrive, truePointsLieOnTheirSurfaces)
{
  SimulationOptions options;
  options.motion_distortion = true;
  const SimulatedDrive drive = townDrive(options, 60);
  std::map<SurfaceKind, int> kinds;
  for (const std::size_t index : {5, 40}) {
    const SimulatedScan scan = drive.simulate(index);
    for (std::size_t i = 0; i < scan.surfaces.size(); i += 2) {
      if (scan.surfaces[i] == BeamHit::kNothing)
        continue;
      const double time =
          scan.scan.stamp +
          LaserModel(coarseLaser(60)).columnTime(static_cast<int>(i % 60));
      ASSERT_LT(distanceFrom(drive.town(), scan.surfaces[i], scan.true_points[i], time),
                1e-9)
          << surfaceKindName(drive.town().surface(scan.surfaces[i]).kind);
      ++kinds[drive.town().surface(scan.surfaces[i]).kind];
    }
  }
  EXPECT_GT(kinds[SurfaceKind::Road], 100);
  EXPECT_GT(kinds[SurfaceKind::Wall], 100);
  EXPECT_GE(kinds.size(), 7U);
}

TEST(SimulatedDrive, distortionIsUndoneByTheTruePoses)
{
  SimulationOptions options;
  options.motion_distortion = true;
  options.noise = false;
  const SimulatedDrive drive = townDrive(options);
  const SimulatedScan scan = drive.simulate(30);
  const Eigen::Isometry3d mid = drive.sensorPose(scan.scan.stamp);
  double largest = 0.0;
  double without = 0.0;
  for (std::size_t i = 0; i < scan.surfaces.size(); ++i) {
    if (scan.surfaces[i] == BeamHit::kNothing)
      continue;
    const Eigen::Vector3d point = (*scan.scan.cloud)[i].getVector3fMap().cast<double>();
    const double time = scan.scan.stamp + scan.scan.point_times[i];
    largest = std::max(largest,
                       (drive.sensorPose(time) * point - scan.true_points[i]).norm());
    without = std::max(without, (mid * point - scan.true_points[i]).norm());
  }
  EXPECT_LT(largest, 5e-5); // single precision of the cloud
  EXPECT_GT(without, 0.2);  // 8 m/s times half a turn, and the turning
}

TEST(SimulatedDrive, moversMove)
{
  const SimulatedDrive drive = townDrive({});
  const Town& town = drive.town();
  ASSERT_FALSE(town.movers().empty());
  int moving = 0;
  for (const Mover& mover : town.movers()) {
    const auto before = town.moverPose(mover, mover.time);
    const auto after = town.moverPose(mover, mover.time + 1.0);
    if (!before || !after || mover.follows)
      continue;
    ++moving;
    EXPECT_NEAR((after->translation() - before->translation()).norm(),
                std::abs(mover.speed),
                0.4 * std::abs(mover.speed) + 0.1);
    EXPECT_FALSE(town.moverPose(mover, mover.end + 0.1));
    EXPECT_GE(mover.first_surface, town.tree().primitives().size());
  }
  EXPECT_GT(moving, 1);
  SimulationOptions still;
  still.town.movers = false;
  EXPECT_TRUE(townDrive(still).town().movers().empty());
}

TEST(SimulatedDrive, heightsOfLegsThatMeetAreEvenedOut)
{
  CircuitOptions options;
  options.laps = 1.5;
  Trajectory lap = makeCircuit(options);
  for (std::size_t k = 0; k < lap.size(); ++k) // the drift of a positioning system
    lap[k].T_world_body.translation().z() += 0.004 * static_cast<double>(k);
  const Town town(lap);
  double before = 0.0;
  double after = 0.0;
  for (std::size_t k = 0; k < lap.size(); ++k)
    for (std::size_t j = 0; j + 100 < k; ++j) {
      const Eigen::Vector3d gap =
          lap[k].T_world_body.translation() - lap[j].T_world_body.translation();
      if (gap.head<2>().norm() > 0.3)
        continue;
      before = std::max(before, std::abs(gap.z()));
      after = std::max(after,
                       std::abs(town.drive()[k].T_world_body.translation().z() -
                                town.drive()[j].T_world_body.translation().z()));
    }
  EXPECT_GT(before, 1.0);
  EXPECT_LT(after, 0.15);
}

TEST(SimulatedDrive, refusesWhatMakesNoSense)
{
  EXPECT_THROW(SimulatedDrive({}, coarseLaser()), std::invalid_argument);
  Trajectory drive = shortDrive(3);
  LaserModel blind = coarseLaser();
  blind.elevations.clear();
  EXPECT_THROW(SimulatedDrive(drive, blind), std::invalid_argument);
  drive[1].stamp = -5.0;
  EXPECT_THROW(SimulatedDrive(drive, coarseLaser()), std::invalid_argument);
  drive = shortDrive(3);
  drive[2].T_world_body.translation().x() = std::nan("");
  EXPECT_THROW(SimulatedDrive(drive, coarseLaser()), std::invalid_argument);
  EXPECT_THROW(townDrive({}).read(10000), std::invalid_argument);
}

} // namespace
