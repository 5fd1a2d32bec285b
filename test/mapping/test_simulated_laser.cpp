// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// The simulated laser in the town: noise, what it loses and what hides it, its raster.

#include "town_drives.h"

#include <gtest/gtest.h>

#include <array>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

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

TEST(SimulatedLaser, noiseHasTheStatisticsOfTheModel)
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

/** By how much the beams of a scan go elsewhere than its raster says, elevation and
 * azimuth in radians, mean and largest difference from it within a beam. */
std::vector<std::array<double, 3>>
angleErrors(const SimulatedDrive& drive, std::size_t index)
{
  const SimulatedScan scan = drive.simulate(index);
  const Eigen::Isometry3d T_sensor_world = drive.sensorPose(scan.scan.stamp).inverse();
  const std::size_t columns = scan.scan.cloud->width;
  std::vector<std::array<double, 3>> result;
  for (std::size_t row = 0; row < scan.scan.cloud->height; ++row) {
    std::vector<Eigen::Vector2d> errors;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t i = row * columns + column;
      if (scan.surfaces[i] == BeamHit::kNothing)
        continue;
      const Eigen::Vector3d went = T_sensor_world * scan.true_points[i];
      const Eigen::Vector3d said =
          (*scan.scan.cloud)[i].getVector3fMap().cast<double>();
      const auto elevation = [](const Eigen::Vector3d& p) {
        return std::atan2(p.z(), p.head<2>().norm());
      };
      const double turn = said.x() * went.y() - said.y() * went.x();
      errors.emplace_back(elevation(went) - elevation(said),
                          turn / (said.head<2>().norm() * went.head<2>().norm()));
      mean += errors.back();
    }
    mean /= static_cast<double>(errors.size());
    double spread = 0.0;
    for (const Eigen::Vector2d& error : errors)
      spread = std::max(spread, (error - mean).norm());
    result.push_back({mean.x(), mean.y(), spread});
  }
  return result;
}

TEST(SimulatedLaser, beamsGoWhereTheirErrorsSayInEveryScan)
{
  const double deviation = LaserModel::hdl64().beam_angle;
  const SimulatedDrive drive = townDrive({}, 100);
  const auto errors = angleErrors(drive, 10);
  const auto later = angleErrors(drive, 25);
  std::array<double, 2> squares{};
  for (std::size_t row = 0; row < errors.size(); ++row) {
    EXPECT_LT(errors[row][2], 2e-6) << row; // the points are of single precision
    for (const std::size_t k : {0U, 1U}) {
      EXPECT_NEAR(errors[row][k], later[row][k], 1e-6) << row;
      squares.at(k) += errors[row][k] * errors[row][k];
    }
  }
  for (const double sum : squares) // 64 errors tell their deviation to 9 %
    EXPECT_NEAR(std::sqrt(sum / 64.0), deviation, 0.3 * deviation);
  SimulationOptions exact;
  exact.noise = false;
  for (const auto& error : angleErrors(townDrive(exact, 100), 10))
    EXPECT_LT(std::hypot(error[0], error[1]), 1e-6);
}

TEST(SimulatedLaser, nearWallsLoseNothingButTheRandomShare)
{
  SimulationOptions options;
  options.town.scene = TownScene::Tunnel;
  const SimulatedScan seen = townDrive(options, 600).simulate(30);
  options.noise = false;
  const SimulatedScan all = townDrive(options, 600).simulate(30);
  double lost = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < all.surfaces.size(); ++i) {
    if (all.surfaces[i] == BeamHit::kNothing ||
        (*all.scan.cloud)[i].getVector3fMap().norm() > 12.0F)
      continue;
    ++total;
    lost += seen.surfaces[i] == BeamHit::kNothing ? 1.0 : 0.0;
  }
  const double share = LaserModel::hdl64().random_loss;
  ASSERT_GT(total, 20000.0);
  EXPECT_NEAR(lost / total, share, 5.0 * std::sqrt(share / total));
}

TEST(SimulatedLaser, theOwnBodyHidesWhatIsBehindIt)
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

TEST(SimulatedLaser, fewerReturnsFromFarAndFlatThanWithoutNoise)
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

TEST(SimulatedLaser, rasterIsTheOneItSays)
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

} // namespace
