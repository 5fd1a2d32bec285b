// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/nurbs/exports.h>

#include <Eigen/Core>

#include <vector>

namespace pcl {

/** \brief How a grid cell names a place in space. */
enum class GridProjection {
  perspective, /**< depth camera: u = x / z, v = y / z, depth = z */
  spherical,   /**< turning laser: u = azimuth, v = depression, depth = range */
  plane,       /**< height field: u = x, v = y, depth = z, all along the grid's axes */
  lattice      /**< neighbours are known, the map from cell to direction is not */
};

/** \brief Parameters of a pinhole camera, in pixels: column = fx x / z + cx. */
struct PinholeIntrinsics {
  double fx = 525.0;
  double fy = 525.0;
  double cx = 319.5;
  double cy = 239.5;
};

/** \brief The raster an organized cloud lies in.
 *
 * The grid's own axes are right, down and forward (the axes of an image), so that
 * columns count along u and rows along v in every projection:
 * u = first_u + column * step_u, v = first_v + row * step_v. A laser whose rows are not
 * equally spaced has their angles in \a row_v instead.
 *
 * Angles in radians, lengths in the cloud's unit (metres). A plain value.
 * \ingroup segmentation
 */
struct PCL_NURBS_SEGMENTATION_EXPORT GridGeometry {
  GridProjection projection = GridProjection::lattice;
  int width = 0;
  int height = 0;
  /** Whether the last column is next to the first one. */
  bool wrap = false;
  /** How many cells apart two samples of one surface may lie: 1 in a sensor's own grid,
   * more where scattered samples leave cells empty. */
  int max_gap = 1;
  /** Rows are the unit vectors right, down and forward in the cloud's frame. */
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  double first_u = 0.0;
  double step_u = 1.0;
  double first_v = 0.0;
  double step_v = 1.0;
  std::vector<double> row_v;

  /** \brief Axes of a camera (x right, y down, z forward). */
  static Eigen::Matrix3d
  cameraFrame();

  /** \brief Axes of a vehicle or laser (x forward, y left, z up). */
  static Eigen::Matrix3d
  vehicleFrame();

  /** \brief Axes of a map seen from above (x right, y up, z towards the viewer). */
  static Eigen::Matrix3d
  mapFrame();

  /** \brief The grid of a pinhole camera. */
  static GridGeometry
  pinhole(int width, int height, const PinholeIntrinsics& intrinsics);

  /** \brief Camera parameters of a perspective grid.
   * \throws std::domain_error when the projection is another one
   */
  PinholeIntrinsics
  intrinsics() const;

  /** \brief Coordinates (u, v, depth) of a point given in the cloud's frame. */
  Eigen::Vector3d
  chart(const Eigen::Vector3d& point) const;

  /** \brief Column and row, not rounded, where (u, v) lies. With unequal rows the row
   * is the one with the nearest angle. O(1), or O(log height) with unequal rows. */
  Eigen::Vector2d
  cell(double u, double v) const;

  /** \brief (u, v) of a place in the grid, whole numbers being the centres of cells;
   * the inverse of cell() but for unequal rows, whose angles are interpolated. */
  Eigen::Vector2d
  chartOfCell(double column, double row) const;

  /** \brief Unit vector, in the cloud's frame, of the ray through (u, v). In a plane
   * grid all rays are parallel.
   * \throws std::domain_error for a lattice
   */
  Eigen::Vector3d
  ray(double u, double v) const;

  /** \brief The ray through a place in the grid: ray() of chartOfCell().
   * \throws std::domain_error for a lattice
   */
  Eigen::Vector3d
  direction(double column, double row) const;

  /** \brief Distance between neighbours in a row, at a depth, on a surface that faces
   * the sensor. */
  double
  columnSpacing(double depth) const;

  /** \brief Distance between neighbours in a column, as columnSpacing(). */
  double
  rowSpacing(double depth) const;
};

} // namespace pcl
