// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Scans of a laser with errors planted in its beams, and what is learnt from them.

#pragma once

#include <pcl/registration/beam_calibration.h>

#include "scene_rays.h"

#include <cmath>
#include <random>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

inline constexpr int kBeams = 32;
inline constexpr double kBeamNoise = 0.01;

/** Elevation of a beam of ringScan(). */
inline double
elevationOf(int beam)
{
  return -0.43 + 0.63 * beam / (kBeams - 1);
}

/** Errors of all beams, with zero mean. */
inline std::vector<BeamError>
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
inline ScanPoints
faultyScan(const Scene& scene,
           const Eigen::Isometry3d& pose,
           const std::vector<BeamError>& errors,
           std::mt19937& random)
{
  ScanPoints points = ringScan(scene, pose, kBeams, 300, kBeamNoise, random);
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

inline Eigen::Isometry3d
poseAt(int scan)
{
  Tangent way;
  way << 0.6, 0.0, 0.0, 0.0, 0.0, 0.01;
  return Eigen::Translation3d(-15.0, 0.0, 0.0) * exponential(scan * way);
}

/** What is learnt from a drive through the street whose poses are known. */
inline BeamCalibration
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

} // namespace test
} // namespace nurbs
} // namespace pcl
