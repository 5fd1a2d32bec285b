// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>
#include <pcl/segmentation/grid_geometry.h>

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A turning laser scanner: at each of its columns all beams measure at once,
 * from one point, one column after the other from behind over the left to the front.
 *
 * A return is lost more often the less light comes back, and for no other reason but
 * random_loss: the signal is reflectivity times sqrt(cos(incidence)) times
 * (signal_range / range)^2, and the share lost 1 / (1 + signal^4). The root, and not
 * the cosine of a matt surface, because rough ground scatters more light back at
 * grazing incidence. A plain value. \ingroup mapping
 */
struct PCL_NURBS_MAPPING_EXPORT LaserModel {
  std::string name;
  std::vector<double> elevations; /**< of the beams from the top, radians */
  int columns = 2000;             /**< per turn */
  double period = 0.1;            /**< of a turn, seconds */
  double range_noise = 0.02;      /**< of each range: standard deviation, metres */
  double min_range = 0.9;         /**< metres */
  double max_range = 120.0;       /**< metres */
  double signal_range = 110.0;   /**< where all light of a white wall gives 1, metres */
  double intensity_noise = 0.03; /**< standard deviation; intensities are 0 to 1 */
  double random_loss = 0.01;     /**< share lost for no reason */
  /** Errors that a beam has in every scan, as left by a calibration: standard
   * deviations between beams of an offset of ranges (metres), of its elevation and its
   * azimuth (radians), and of a share of intensities. Points are where \a elevations
   * say, true points where the beam went. */
  double beam_offset = 0.0;
  double beam_angle = 0.0;
  double beam_gain = 0.0;
  /** Parts of the vehicle, in the sensor's frame: beams that meet one give nothing. */
  std::vector<Eigen::AlignedBox3d> own_body;

  /** \brief Velodyne HDL-64E as on KITTI's car: 2160 firings a turn, its 64 beams from
   * 1.94 down to -25 degrees, ranges cut at 80 m, the noise and the roof around it. Its
   * beams start 0.12 m (lower half) or 0.2 m (upper half) above the origin of KITTI's
   * frame, here all at the origin: the sensor is that much higher above the road. */
  static LaserModel
  hdl64();

  /** \brief 32 beams from 10.67 to -30.67 degrees (Velodyne HDL-32E). */
  static LaserModel
  hdl32();

  /** \brief 16 beams from 15 to -15 degrees, 3 cm noise (Velodyne VLP-16). */
  static LaserModel
  vlp16();

  /** \brief The raster of a scan: rows are beams, columns go from behind over the left,
   * front and right. */
  GridGeometry
  geometry() const;

  /** \brief When a column is measured, seconds from the scan's stamp, at which the
   * scanner looks ahead. */
  double
  columnTime(int column) const
  {
    return period * ((column + 0.5) / columns - 0.5);
  }
};

/** \brief A depth camera by triangulation between a projector and a camera to its left:
 * disparities with noise and in steps; no reading where the projector's light does not
 * come, beyond the range, or on a surface seen too obliquely. A plain value.
 * \ingroup mapping */
struct PCL_NURBS_MAPPING_EXPORT DepthCameraModel {
  std::string name;
  int width = 640;
  int height = 480;
  PinholeIntrinsics intrinsics;
  double base = 0.075;              /**< from camera to projector, metres */
  double disparity_noise = 0.06;    /**< standard deviation, pixels */
  double disparity_step = 1.0 / 8.; /**< pixels */
  double min_depth = 0.5;           /**< metres */
  double max_depth = 8.0;           /**< metres */
  double least_cosine = 0.12;       /**< of the angle of incidence */
  double period = 1.0 / 30.0;       /**< seconds */

  /** \brief Microsoft Kinect v1. */
  static DepthCameraModel
  kinect();
};

} // namespace nurbs
} // namespace pcl
