// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Drives through the simulated town against what is true about them.

#include <pcl/mapping/simulator/circuits.h>
#include <pcl/mapping/simulator/simulated_drive.h>
#include <pcl/surface/nurbs/closest_point.h>

#include <gtest/gtest.h>

#include <cstring>
#include <map>

namespace {

using namespace pcl::nurbs;

LaserModel
coarseLaser(int columns = 200)
{
  LaserModel laser = LaserModel::hdl64();
  laser.columns = columns;
  return laser;
}

Trajectory
shortDrive(std::size_t poses = 60)
{
  CircuitOptions options;
  options.shape = CircuitShape::Eight;
  options.laps = 0.5;
  Trajectory drive = makeCircuit(options);
  drive.resize(std::min(poses, drive.size()));
  return drive;
}

SimulatedDrive
townDrive(const SimulationOptions& options, int columns = 200)
{
  return SimulatedDrive(shortDrive(), coarseLaser(columns), options);
}

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

TEST(SimulatedDrive, noiseHasTheStatisticsOfTheModel)
{
  const SimulatedDrive drive = townDrive({}, 600);
  const SimulatedScan scan = drive.simulate(10);
  const Eigen::Vector3d place = drive.sensorPose(scan.scan.stamp).translation();
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < scan.surfaces.size(); ++i) {
    if (scan.surfaces[i] == BeamHit::kNothing)
      continue;
    const double error = (*scan.scan.cloud)[i].getVector3fMap().cast<double>().norm() -
                         (scan.true_points[i] - place).norm();
    sum += error;
    squares += error * error;
    ++count;
  }
  ASSERT_GT(count, 20000.0);
  EXPECT_NEAR(sum / count, 0.0, 4.0 * 0.02 / std::sqrt(count));
  EXPECT_NEAR(std::sqrt(squares / count), 0.02, 0.0005);
}

TEST(SimulatedDrive, fewerReturnsFromFarAndFlatThanWithoutNoise)
{
  SimulationOptions exact;
  exact.noise = false;
  const SimulatedScan all = townDrive(exact).simulate(10);
  const SimulatedScan seen = townDrive({}).simulate(10);
  std::array<double, 2> lost{};
  std::array<double, 2> total{};
  for (std::size_t i = 0; i < all.surfaces.size(); ++i) {
    if (all.surfaces[i] == BeamHit::kNothing)
      continue;
    const bool far = (*all.scan.cloud)[i].getVector3fMap().norm() > 35.0F;
    ++total[far ? 1 : 0];
    lost[far ? 1 : 0] += seen.surfaces[i] == BeamHit::kNothing ? 1.0 : 0.0;
  }
  EXPECT_LT(lost[0] / total[0], 0.15);
  EXPECT_GT(lost[1] / total[1], 2.0 * lost[0] / total[0]);
}

TEST(SimulatedDrive, rasterIsTheOneItSays)
{
  SimulationOptions options;
  options.noise = false;
  const Scan scan = townDrive(options).read(3);
  ASSERT_TRUE(scan.geometry);
  for (std::uint32_t row = 0; row < scan.cloud->height; row += 7)
    for (std::uint32_t column = 0; column < scan.cloud->width; column += 3) {
      const Eigen::Vector3d point =
          scan.cloud->at(static_cast<int>(column), static_cast<int>(row))
              .getVector3fMap()
              .cast<double>();
      if (!point.allFinite())
        continue;
      const Eigen::Vector3d ray = scan.geometry->direction(column, row);
      ASSERT_LT((point.normalized() - ray).norm(), 1e-6);
    }
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

TEST(SimulatedDrive, nothingStandsWhereTheDriveGoes)
{
  const SimulatedDrive drive = townDrive({});
  for (const StampedPose& pose : drive.town().drive())
    for (const double angle : {0.0, 1.6, 3.2, 4.7}) {
      const Beam beam{pose.T_world_body.translation(),
                      {std::cos(angle), std::sin(angle), 0.0}};
      ASSERT_EQ(drive.town().tree().cast(beam, 0.0, 1.0).surface, BeamHit::kNothing);
    }
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

TEST(SimulatedDrive, standingStillAndOnePoseWork)
{
  Trajectory still(4);
  for (std::size_t k = 0; k < still.size(); ++k)
    still[k].stamp = 0.1 * static_cast<double>(k);
  EXPECT_EQ(SimulatedDrive(still, coarseLaser()).size(), 4U);
  const SimulatedDrive one(Trajectory(1), coarseLaser());
  const Scan scan = one.read(0);
  int returns = 0;
  for (const pcl::PointXYZI& point : *scan.cloud)
    returns += std::isfinite(point.x) ? 1 : 0;
  EXPECT_GT(returns, 5000);
}

} // namespace
