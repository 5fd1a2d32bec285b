// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Drives through the simulated town against what is true about them.

#include <pcl/mapping/simulator/circuits.h>
#include <pcl/mapping/simulator/simulated_drive.h>
#include <pcl/surface/nurbs/closest_point.h>

#include <gtest/gtest.h>

#include <array>
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

/** Errors of the ranges of each beam: count, mean, standard deviation. */
std::vector<std::array<double, 3>>
errorsByBeam(const SimulatedDrive& drive, std::size_t index)
{
  const SimulatedScan scan = drive.simulate(index);
  const Eigen::Vector3d place = drive.sensorPose(scan.scan.stamp).translation();
  const std::size_t columns = scan.scan.cloud->width;
  std::vector<std::array<double, 3>> result;
  for (std::size_t row = 0; row < scan.scan.cloud->height; ++row) {
    double count = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = row * columns; i < (row + 1) * columns; ++i) {
      if (scan.surfaces[i] == BeamHit::kNothing)
        continue;
      const double error =
          (*scan.scan.cloud)[i].getVector3fMap().cast<double>().norm() -
          (scan.true_points[i] - place).norm();
      ++count;
      sum += error;
      squares += error * error;
    }
    const double mean = sum / count;
    result.push_back({count, mean, std::sqrt(squares / count - mean * mean)});
  }
  return result;
}

TEST(SimulatedDrive, noiseHasTheStatisticsOfTheModel)
{
  const SimulatedDrive drive = townDrive({}, 600);
  const LaserModel laser = LaserModel::hdl64();
  const auto errors = errorsByBeam(drive, 10);
  const auto later = errorsByBeam(drive, 11);
  double offsets = 0.0;
  for (std::size_t row = 0; row < errors.size(); ++row) {
    const auto [count, mean, deviation] = errors[row];
    ASSERT_GT(count, 100.0) << row;
    EXPECT_NEAR(deviation, laser.range_noise, 4.0 * 0.011 / std::sqrt(2.0 * count));
    const double few = std::min(count, later[row][0]);
    EXPECT_NEAR(mean, later[row][1], 5.0 * laser.range_noise * std::sqrt(2.0 / few));
    offsets += mean * mean / static_cast<double>(errors.size());
  }
  // 64 offsets tell their deviation to a share of 1 / sqrt(128).
  EXPECT_NEAR(std::sqrt(offsets), laser.beam_offset, 0.3 * laser.beam_offset);
}

TEST(SimulatedDrive, theOwnBodyHidesWhatIsBehindIt)
{
  SimulationOptions options;
  options.noise = false;
  LaserModel laser = coarseLaser(360);
  laser.own_body.clear();
  const Scan open = SimulatedDrive(shortDrive(), laser, options).read(3);
  // A wall behind: from -60 to 60 degrees about it, up to 10 degrees below the horizon.
  laser.own_body = {{Eigen::Vector3d(-1.1, -std::sqrt(3.0), -2.0),
                     Eigen::Vector3d(-1.0, std::sqrt(3.0), -std::tan(M_PI / 18.0))}};
  const Scan hidden = SimulatedDrive(shortDrive(), laser, options).read(3);
  int gone = 0;
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 360; ++column) {
      const bool was = std::isfinite(open.cloud->at(column, row).x);
      const bool is = std::isfinite(hidden.cloud->at(column, row).x);
      const bool behind = column < 60 || column >= 300;
      const double azimuth = (column + 0.5) * M_PI / 180.0;
      const double wall = std::tan(M_PI / 18.0) * std::cos(azimuth);
      const double down = std::tan(-laser.elevations[static_cast<std::size_t>(row)]);
      if (behind && down > wall + 1e-9) { // below the top of the front side
        EXPECT_FALSE(is) << row << ' ' << column;
      }
      else if (!behind || down < wall / 1.1 - 1e-9) { // above the top altogether
        EXPECT_EQ(is, was) << row << ' ' << column;
      }
      gone += was && !is ? 1 : 0;
    }
  EXPECT_GT(gone, 1000);
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
