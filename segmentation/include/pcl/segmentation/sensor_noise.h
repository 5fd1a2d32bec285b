// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_points.h>

namespace pcl {

/** \brief Standard deviation of a sensor's depth (camera: z, laser: range) as a
 * function of the depth: sigma = constant + quadratic (depth - reference)^2, metres.
 * \ingroup segmentation
 */
struct PCL_NURBS_SEGMENTATION_EXPORT SensorNoise {
  double constant = 0.0;
  double quadratic = 0.0;
  double reference = 0.0;

  double
  sigma(double depth) const
  {
    const double beyond = depth - reference;
    return constant + quadratic * beyond * beyond;
  }

  /** \brief Kinect v1, axial noise of a surface that faces the sensor (Nguyen, Izadi,
   * Lovell, "Modeling Kinect Sensor Noise for Improved 3D Reconstruction and Tracking",
   * 3DIMPVT 2012). */
  static SensorNoise
  kinect();

  /** \brief Velodyne HDL-64E: 2 cm at any range. */
  static SensorNoise
  hdl64();

  /** \brief Measure the noise in the cloud itself.
   *
   * On a plane the inverse depth of a camera or laser is (nearly) linear along a row,
   * so its second difference is noise alone; the median over a bin of depths ignores
   * edges and curved places. In a plane grid the height takes the place of the inverse
   * depth. Camera rows are sampled every few pixels because quantisation and
   * correlation hide the noise between next neighbours.
   *
   * O(n). Without enough samples the result is 0.1 % of the median depth.
   * \param[in] points cloud
   * \param[in] threads number of threads; the result does not depend on it
   * \throws std::invalid_argument when there is no thread
   */
  static SensorNoise
  estimate(const nurbs::GridPoints& points, int threads = 1);
};

} // namespace pcl
