// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/voxel_map.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief What a beam's readings are off by, all of them alike.
 * \ingroup registration */
struct BeamError {
  double range = 0.0;     /**< metres, positive is too far */
  double elevation = 0.0; /**< radians, positive is too high */
  double azimuth = 0.0;   /**< radians, positive is too far left */
};

/** \brief Parameters of BeamCalibration; metres and radians.
 * \ingroup registration */
struct BeamCalibrationOptions {
  /** Largest standard deviations of what a calibration leaves: 3.5 cm and 0.03 degrees,
   * as rings of KITTI's HDL-64E are off from each other. */
  BeamError expected{0.035, 5.2e-4, 5.2e-4};
  /** Of a point's distance from its surface. Much more than the noise of a reading:
   * what one scan sees of a place others see as well, and with the same errors. */
  double residual_deviation = 0.3;
  /** Points farther than this from their surface do not belong to it. */
  double max_residual = 0.15;
  /** The sensor moves by so much, which may be nothing, before it learns again ... */
  double way = 0.5;
  /** ... and what a scan taught fades with so many others (to 1/e). */
  double memory = 200.0;
};

/** \brief Learns from a drive what a turning laser's calibration left.
 *
 * Each beam of a laser has errors of its own that do not change. Averages over many
 * scans do not remove them: surfaces ahead are first seen by the beams that look far
 * and then by others, so that every scan is drawn the same way, and the trajectory
 * bends. But they show in the distances of points from the surfaces they are matched
 * with,
 *
 * \f[ e = n^T (u \, \delta + e_\theta \, r \, \epsilon + e_\phi \, l \, \alpha), \f]
 *
 * n the normal, u the ray, r the range and l its level part. The errors of range,
 * elevation and azimuth are found by least squares for each interval of the elevation's
 * sine (a tenth of a degree at the horizon), with a prior whose variances are those of
 * the errors themselves: how much they differ from beam to beam (empirical Bayes), at
 * most what is expected. So little is taken out of a laser that has no such errors.
 * What beams share with their neighbours within 8 degrees is left: bent roads and the
 * trajectory itself look the same. (Levinson and Thrun, ISER 2010, calibrate a Velodyne
 * by the same principle, from a whole drive.)
 *
 * Beams are told apart by the elevation of their points in the sensor's frame, z up;
 * where several share one, they get their common error. 150 kB.
 * \ingroup registration */
class PCL_NURBS_REGISTRATION_EXPORT BeamCalibration {
public:
  /** \brief Number of an interval of elevation. */
  using Beam = std::uint16_t;

  /** \throws std::invalid_argument when an option is not positive, or too small or too
   * large to be squared */
  explicit BeamCalibration(const BeamCalibrationOptions& options = {});

  /** \brief Which beam each point was measured with. O(points)
   * \param[in] points in the sensor's frame when it measured them. Those at its origin,
   * or not finite, are taken for the horizon's; nothing is learnt from them */
  static std::vector<Beam>
  beamsOf(const ScanPoints& points);

  /** \brief Take out of points what is known of their beams' errors. O(points)
   * \param[in,out] points as for beamsOf()
   * \throws std::invalid_argument when there is not one beam of beamsOf() per point */
  void
  correct(ScanPoints& points, const std::vector<Beam>& beams) const;

  /** \brief Learn from a scan that was aligned, if the sensor moved far enough since
   * the last one. O(points)
   * \param[in] map what the scan was aligned with, without it
   * \param[in] points corrected, in the frame of \a pose
   * \param[in] measured the same points, corrected, in the sensor's frame when it
   * measured each: \a points themselves unless they were deskewed
   * \param[in] pose from that frame to the map's; nothing is learnt from one that is not
   * finite
   * \param[in] threads the result does not depend on it
   * \throws std::invalid_argument when there is not one measured point, and one beam of
   * beamsOf(), per point, or no thread */
  void
  learn(const VoxelMap& map,
        const ScanPoints& points,
        const ScanPoints& measured,
        const std::vector<Beam>& beams,
        const Eigen::Isometry3d& pose,
        int threads = 1);

  /** \brief What is known of the beam at an elevation (radians). */
  BeamError
  error(double elevation) const;

private:
  /** Normal equations of a beam's errors, and their solution. */
  struct Learned {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    Eigen::Vector3d error = Eigen::Vector3d::Zero(); // range, elevation, azimuth
  };

  void
  forgetSome();

  /** Errors by what was learnt and how much they differ from beam to beam. */
  void
  solve();

  /** Errors for such variances of their kinds, without what neighbours share; the
   * variances that these have. */
  Eigen::Array3d
  solveWith(const Eigen::Array3d& variance);

  BeamCalibrationOptions options_;
  std::vector<Learned> beams_;
  Eigen::Vector3d learned_at_ = Eigen::Vector3d::Zero();
  bool any_ = false;
};

} // namespace nurbs
} // namespace pcl
