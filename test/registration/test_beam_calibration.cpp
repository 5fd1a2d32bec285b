// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Errors planted in a laser's beams come back from a drive; a laser without errors
// stays as it is.

#include <pcl/registration/scan_odometry.h>

#include "faulty_beams.h"

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** How much of the planted errors is left, by kind. */
Eigen::Array3d
shareLeft(const BeamCalibration& calibration, const std::vector<BeamError>& errors)
{
  Eigen::Array3d left = Eigen::Array3d::Zero();
  Eigen::Array3d planted = Eigen::Array3d::Zero();
  for (int beam = 0; beam < kBeams; ++beam) {
    const BeamError& truth = errors[static_cast<std::size_t>(beam)];
    const BeamError found = calibration.error(elevationOf(beam) + truth.elevation);
    left += Eigen::Array3d(found.range - truth.range,
                           found.elevation - truth.elevation,
                           found.azimuth - truth.azimuth)
                .square();
    planted += Eigen::Array3d(truth.range, truth.elevation, truth.azimuth).square();
  }
  return (left / planted).sqrt();
}

TEST(BeamCalibration, plantedErrorsComeBack)
{
  const std::vector<BeamError> errors = plantedErrors(1.0);
  const Eigen::Array3d left = shareLeft(drive(errors, 50), errors);
  EXPECT_LT(left[0], 0.35);
  EXPECT_LT(left[1], 0.9); // angles show little in so short a drive
  EXPECT_LT(left[2], 0.9);
}

TEST(BeamCalibration, odometryLearnsOnItsWay)
{
  const std::vector<BeamError> errors = plantedErrors(1.0);
  OdometryOptions options;
  options.min_range = 0.5;
  options.map_spacing = options.match_spacing = 0.1; // learn from most points
  options.max_match_points = 10000;
  ScanOdometry odometry(options);
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i)
    EXPECT_TRUE(
        odometry.process(faultyScan(street(), poseAt(i), errors, random)).tracked);
  EXPECT_LT(shareLeft(odometry.beamCalibration(), errors)[0], 0.6);
  options.calibrate_beams = false;
  ScanOdometry as_is(options);
  for (int i = 0; i < 3; ++i)
    as_is.process(faultyScan(street(), poseAt(i), errors, random));
  EXPECT_EQ(shareLeft(as_is.beamCalibration(), errors)[0], 1.0);
}

TEST(BeamCalibration, errorsAreAlongTheRaysThatWereMeasured)
{
  // The same drive seen from a sensor that was two metres to the left of the poses:
  // what is learnt depends on where points were measured from, not on the frame they
  // are in.
  const std::vector<BeamError> errors = plantedErrors(1.0);
  const Eigen::Translation3d aside(0.0, -2.0, 0.0);
  BeamCalibration calibration;
  VoxelMap map;
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    ScanPoints measured = faultyScan(street(), poseAt(i), errors, random);
    const auto beams = BeamCalibration::beamsOf(measured);
    calibration.correct(measured, beams);
    ScanPoints points;
    for (const Eigen::Vector3f& point : measured)
      points.emplace_back((aside.inverse() * point.cast<double>()).cast<float>());
    calibration.learn(map, points, measured, beams, poseAt(i) * aside);
    for (const Eigen::Vector3f& point : measured)
      map.insert(poseAt(i) * point.cast<double>());
  }
  const BeamCalibration direct = drive(errors, 20);
  for (int beam = 0; beam < kBeams; ++beam)
    EXPECT_NEAR(calibration.error(elevationOf(beam)).range,
                direct.error(elevationOf(beam)).range,
                1e-4);
}

TEST(BeamCalibration, goodBeamsStayAsTheyAre)
{
  const BeamCalibration calibration = drive(plantedErrors(0.0), 50);
  for (int beam = 0; beam < kBeams; ++beam) {
    const BeamError found = calibration.error(elevationOf(beam));
    EXPECT_LT(std::abs(found.range), 5e-4);
    EXPECT_LT(std::abs(found.elevation), 5e-5);
    EXPECT_LT(std::abs(found.azimuth), 5e-5);
  }
}

TEST(BeamCalibration, whatBeamsShareWithTheirNeighboursIsLeft)
{
  // Bent roads, and the trajectory itself, make such residuals as well.
  std::vector<BeamError> errors = plantedErrors(0.0);
  for (int beam = 0; beam < kBeams; ++beam)
    errors[static_cast<std::size_t>(beam)].range = 0.02 * elevationOf(beam) / 0.43;
  const BeamCalibration calibration = drive(errors, 50);
  for (int beam = 0; beam < kBeams; ++beam)
    EXPECT_LT(std::abs(calibration.error(elevationOf(beam)).range), 2e-3);
}

TEST(BeamCalibration, correctingTakesOutWhatIsKnown)
{
  const BeamCalibration calibration = drive(plantedErrors(1.0), 20);
  const double elevation = elevationOf(12) + plantedErrors(1.0)[12].elevation;
  const BeamError error = calibration.error(elevation);
  ASSERT_GT(std::abs(error.range), 1e-4);
  const Eigen::Vector3d ray(std::cos(elevation) * std::cos(0.7),
                            std::cos(elevation) * std::sin(0.7),
                            std::sin(elevation));
  ScanPoints points{(20.0 * ray).cast<float>()};
  calibration.correct(points, BeamCalibration::beamsOf(points));
  const Eigen::Vector3d p = points[0].cast<double>();
  EXPECT_NEAR(p.norm(), 20.0 - error.range, 1e-4);
  EXPECT_NEAR(std::atan2(p.z(), p.head<2>().norm()), elevation - error.elevation, 1e-5);
  EXPECT_NEAR(std::atan2(p.y(), p.x()), 0.7 - error.azimuth, 1e-5);
}

TEST(BeamCalibration, moreIsLearntWhenMoreIsExpected)
{
  const std::vector<BeamError> errors = plantedErrors(1.0);
  BeamCalibrationOptions shy;
  shy.expected.range = 1e-3;
  EXPECT_GT(shareLeft(drive(errors, 20, 2, shy), errors)[0],
            2.0 * shareLeft(drive(errors, 20), errors)[0]);
}

TEST(BeamCalibration, learnsTheSameWithAnyNumberOfThreads)
{
  const std::vector<BeamError> errors = plantedErrors(1.0);
  const BeamCalibration one = drive(errors, 6, 1);
  const BeamCalibration three = drive(errors, 6, 3);
  for (int beam = 0; beam < kBeams; ++beam) {
    const double elevation =
        elevationOf(beam) + errors[static_cast<std::size_t>(beam)].elevation;
    EXPECT_NE(one.error(elevation).range, 0.0);
    EXPECT_EQ(one.error(elevation).range, three.error(elevation).range);
    EXPECT_EQ(one.error(elevation).elevation, three.error(elevation).elevation);
    EXPECT_EQ(one.error(elevation).azimuth, three.error(elevation).azimuth);
  }
}

} // namespace
