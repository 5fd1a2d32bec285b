// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Errors planted in a laser's beams come back from a drive; a laser without errors
// stays as it is.

#include <pcl/registration/beam_calibration.h>
#include <pcl/registration/scan_odometry.h>

#include "scene_rays.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

constexpr int kBeams = 32;
constexpr double kNoise = 0.01;

/** Elevation of a beam of ringScan(). */
double
elevationOf(int beam)
{
  return -0.43 + 0.63 * beam / (kBeams - 1);
}

/** Errors of all beams, with zero mean. */
std::vector<BeamError>
plantedErrors(double scale)
{
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<BeamError> errors(kBeams);
  BeamError mean;
  for (BeamError& error : errors) {
    error = {scale * 0.035 * normal(random),
             scale * 5e-4 * normal(random),
             scale * 5e-4 * normal(random)};
    mean.range += error.range / kBeams;
    mean.elevation += error.elevation / kBeams;
    mean.azimuth += error.azimuth / kBeams;
  }
  for (BeamError& error : errors)
    error = {error.range - mean.range,
             error.elevation - mean.elevation,
             error.azimuth - mean.azimuth};
  return errors;
}

/** A scan of exact beams with its beams' errors put in. */
ScanPoints
faultyScan(const Scene& scene,
           const Eigen::Isometry3d& pose,
           const std::vector<BeamError>& errors,
           std::mt19937& random)
{
  ScanPoints points = ringScan(scene, pose, kBeams, 300, kNoise, random);
  for (Eigen::Vector3f& point : points) {
    const Eigen::Vector3d p = point.cast<double>();
    const double elevation = std::atan2(p.z(), p.head<2>().norm());
    const auto beam =
        static_cast<std::size_t>(std::lround((elevation + 0.43) / 0.63 * (kBeams - 1)));
    const BeamError& error = errors[beam];
    const double up = elevation + error.elevation;
    const double turn = std::atan2(p.y(), p.x()) + error.azimuth;
    point = ((p.norm() + error.range) * Eigen::Vector3d(std::cos(up) * std::cos(turn),
                                                        std::cos(up) * std::sin(turn),
                                                        std::sin(up)))
                .cast<float>();
  }
  return points;
}

Eigen::Isometry3d
poseAt(int scan)
{
  Tangent way;
  way << 0.6, 0.0, 0.0, 0.0, 0.0, 0.01;
  return Eigen::Translation3d(-15.0, 0.0, 0.0) * exponential(scan * way);
}

/** What is learnt from a drive through the street whose poses are known. */
BeamCalibration
drive(const std::vector<BeamError>& errors,
      int scans,
      int threads = 2,
      const BeamCalibrationOptions& options = {})
{
  BeamCalibration calibration(options);
  VoxelMap map;
  std::mt19937 random(3);
  for (int i = 0; i < scans; ++i) {
    ScanPoints points = faultyScan(street(), poseAt(i), errors, random);
    const auto beams = BeamCalibration::beamsOf(points);
    calibration.correct(points, beams);
    calibration.learn(map, points, points, beams, poseAt(i), threads);
    for (const Eigen::Vector3f& point : points)
      map.insert(poseAt(i) * point.cast<double>());
  }
  return calibration;
}

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

/** The street as one scan saw it, and another scan from the same place. */
struct Place {
  std::vector<BeamError> errors = plantedErrors(1.0);
  VoxelMap map;
  ScanPoints points;
  std::vector<BeamCalibration::Beam> beams;

  Place()
  {
    std::mt19937 random(3);
    for (const Eigen::Vector3f& point : faultyScan(street(), poseAt(0), errors, random))
      map.insert(poseAt(0) * point.cast<double>());
    points = faultyScan(street(), poseAt(0), errors, random);
    beams = BeamCalibration::beamsOf(points);
  }

  double
  rangeError(const BeamCalibration& calibration) const
  {
    return calibration.error(elevationOf(12) + errors[12].elevation).range;
  }
};

TEST(BeamCalibration, learnsNothingWhileItStands)
{
  const Place place;
  BeamCalibration calibration;
  calibration.learn(place.map, place.points, place.points, place.beams, poseAt(0));
  const double once = place.rangeError(calibration);
  EXPECT_NE(once, 0.0);
  calibration.learn(place.map, place.points, place.points, place.beams, poseAt(0));
  EXPECT_EQ(place.rangeError(calibration), once);
  BeamCalibrationOptions options;
  options.way = 0.0;
  BeamCalibration always(options);
  for (int i = 0; i < 2; ++i)
    always.learn(place.map, place.points, place.points, place.beams, poseAt(0));
  EXPECT_NE(place.rangeError(always), once);
}

TEST(BeamCalibration, whatMatchesNothingTeachesNothing)
{
  const Place place;
  Eigen::Isometry3d nowhere = poseAt(0);
  nowhere.translation().x() = std::numeric_limits<double>::quiet_NaN();
  BeamCalibration calibration;
  calibration.learn(VoxelMap(), place.points, place.points, place.beams, poseAt(0));
  calibration.learn(place.map, place.points, place.points, place.beams, nowhere);
  calibration.learn(place.map, {}, {}, {}, poseAt(0));
  EXPECT_EQ(place.rangeError(calibration), 0.0);
  // Nor is the place taken for one that was learnt from.
  calibration.learn(place.map, place.points, place.points, place.beams, poseAt(0));
  EXPECT_NE(place.rangeError(calibration), 0.0);
}

TEST(BeamCalibration, oddPointsDoNoHarm)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  BeamCalibration calibration = drive(plantedErrors(1.0), 6);
  ScanPoints points{{0, 0, 0}, {0, 0, 5}, {0, 0, -5}, {nan, 0, 0}};
  const auto beams = BeamCalibration::beamsOf(points);
  const ScanPoints before = points;
  calibration.correct(points, beams);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(points[i], before[i]);
  EXPECT_FALSE(points[3].allFinite());
  VoxelMap map;
  for (float x = -1.0F; x < 1.0F; x += 0.1F)
    for (float y = -1.0F; y < 1.0F; y += 0.1F)
      map.insert({x, y, 0.0});
  calibration.learn(map, points, points, beams, Eigen::Isometry3d::Identity());
  for (int beam = 0; beam < kBeams; ++beam)
    EXPECT_TRUE(std::isfinite(calibration.error(elevationOf(beam)).range));
  EXPECT_EQ(calibration.error(std::numeric_limits<double>::quiet_NaN()).range,
            calibration.error(0.0).range);
}

TEST(BeamCalibration, beamsThatAreNotOfThePointsAreRefused)
{
  Place place;
  BeamCalibration calibration;
  const auto pose = poseAt(0);
  const ScanPoints& points = place.points;
  const std::vector<BeamCalibration::Beam> wild(points.size(), 60000);
  EXPECT_THROW(calibration.learn(place.map, points, points, {}, pose),
               std::invalid_argument);
  EXPECT_THROW(calibration.learn(place.map, points, points, wild, pose),
               std::invalid_argument);
  EXPECT_THROW(calibration.learn(place.map, points, {}, {}, pose),
               std::invalid_argument);
  EXPECT_THROW(calibration.learn(place.map, points, points, place.beams, pose, 0),
               std::invalid_argument);
  EXPECT_THROW(calibration.correct(place.points, {}), std::invalid_argument);
  EXPECT_THROW(calibration.correct(place.points, wild), std::invalid_argument);
}

TEST(BeamCalibration, optionsThatMakeNoSenseAreRefused)
{
  BeamCalibrationOptions options;
  options.residual_deviation = 0.0;
  EXPECT_THROW(BeamCalibration{options}, std::invalid_argument);
  options = {};
  options.expected.azimuth = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(BeamCalibration{options}, std::invalid_argument);
  options = {};
  options.expected.range = std::numeric_limits<double>::infinity();
  EXPECT_THROW(BeamCalibration{options}, std::invalid_argument);
  options = {};
  options.expected.range = 1e-200; // its square is 0
  EXPECT_THROW(BeamCalibration{options}, std::invalid_argument);
  options = {};
  options.way = -1.0;
  EXPECT_THROW(BeamCalibration{options}, std::invalid_argument);
}

} // namespace
