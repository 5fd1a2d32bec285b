// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// BeamCalibration of scans that teach nothing, of odd points and wrong arguments.

#include "faulty_beams.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

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

TEST(BeamCalibrationInput, learnsNothingWhileItStands)
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

TEST(BeamCalibrationInput, whatMatchesNothingTeachesNothing)
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

TEST(BeamCalibrationInput, oddPointsDoNoHarm)
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

TEST(BeamCalibrationInput, beamsThatAreNotOfThePointsAreRefused)
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

TEST(BeamCalibrationInput, optionsThatMakeNoSenseAreRefused)
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
