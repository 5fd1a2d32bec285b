// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>
#include <pcl/mapping/trajectory.h>
#include <pcl/segmentation/grid_geometry.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief One scan of a sequence, in the sensor's own frame, metres.
 * \ingroup mapping */
struct Scan {
  pcl::PointCloud<pcl::PointXYZI>::Ptr cloud;
  /** When the scan was taken, seconds, on the clock of the source. */
  double stamp = 0.0;
  /** When each point was measured, seconds from \a stamp; empty if that is not known or
   * all points were measured at once. */
  std::vector<float> point_times;
  /** The raster of an organized cloud, where it is known. */
  std::optional<GridGeometry> geometry;
};

/** \brief A sequence of scans: a data set on disk, or a simulator.
 *
 * Scans are made or read one at a time, on demand and in any order, so that memory does
 * not grow with the length of the sequence. Const members may be called from many
 * threads at once. \ingroup mapping
 */
class PCL_NURBS_MAPPING_EXPORT ScanSource {
public:
  virtual ~ScanSource();

  /** \brief Number of scans, at least one. */
  virtual std::size_t
  size() const = 0;

  /** \brief Time of a scan, seconds; never less than that of the scan before.
   * \throws std::invalid_argument when there is no such scan */
  virtual double
  stamp(std::size_t index) const = 0;

  /** \brief Read a scan.
   * \throws InputError "FILE: reason" when its file is missing or damaged
   * \throws std::invalid_argument when there is no such scan */
  virtual Scan
  read(std::size_t index) const = 0;

  /** \brief True poses of the sensor at the stamps of the scans that have one, which
   * need not be all; null where none is known. */
  virtual const Trajectory*
  truth() const = 0;

  /** \brief From the frame of the sensor to the frame that the data set gives its poses
   * in (KITTI: the left camera); the identity where they are the same. */
  virtual Eigen::Isometry3d
  calibration() const = 0;

  /** \brief What had to be left out when the source was opened, one line each. */
  virtual const std::vector<std::string>&
  problems() const = 0;
};

} // namespace nurbs
} // namespace pcl
