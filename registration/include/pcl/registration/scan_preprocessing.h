// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/rigid_motion.h>
#include <pcl/registration/voxel_map.h>

#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include <limits>

namespace pcl {
namespace nurbs {

/** \brief The finite points of a cloud, in its order. */
template <typename PointT>
ScanPoints
finitePoints(const pcl::PointCloud<PointT>& cloud)
{
  ScanPoints points;
  points.reserve(cloud.size());
  for (const PointT& point : cloud)
    if (point.getVector3fMap().allFinite())
      points.emplace_back(point.getVector3fMap());
  return points;
}

/** \brief The finite points among some of a cloud. */
template <typename PointT>
ScanPoints
finitePoints(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices)
{
  ScanPoints points;
  points.reserve(indices.size());
  for (const auto index : indices)
    if (cloud[static_cast<std::size_t>(index)].getVector3fMap().allFinite())
      points.emplace_back(cloud[static_cast<std::size_t>(index)].getVector3fMap());
  return points;
}

/** \brief The first point in each voxel, in the scan's order: real points, no averages.
 * Points that are not finite are dropped. O(points)
 * \throws std::invalid_argument when the size is not positive */
PCL_NURBS_REGISTRATION_EXPORT ScanPoints
voxelSubsample(const ScanPoints& points, double voxel_size);

/** \brief So many points at most, evenly chosen in the scan's order. O(points) */
PCL_NURBS_REGISTRATION_EXPORT ScanPoints
thinned(const ScanPoints& points, std::size_t most);

/** \brief A size of voxels that suits a cloud: the smallest at which about as many
 * places look flat as at any other size up to a sixteenth of the extent. O(points)
 * \param[in] points finite points
 * \return metres; 1 for fewer than ten points or no extent */
PCL_NURBS_REGISTRATION_EXPORT double
suitableVoxelSize(const ScanPoints& points);

/** \brief Whether a scan is one of a laser with few beams: rings with at least 50
 * points each in less than 15 % of the intervals, of a tenth of a degree, of its field
 * of view. Beams are then some 0.7 degrees apart or more, and leave gaps wider than
 * voxels. O(points)
 * \param[in] points in the sensor's frame when it measured them; may be thinned */
PCL_NURBS_REGISTRATION_EXPORT bool
isSparse(const ScanPoints& points);

/** \brief By how much the vertical angles of KITTI's intrinsic calibration are too low,
 * radians (Deschaud, IMLS-SLAM, ICRA 2018). */
constexpr double kKittiVerticalAngle = 0.205 * 3.14159265358979323846 / 180.0;

/** \brief Raises points by an angle as seen from a sensor whose vertical is z; ranges
 * and azimuths do not change. */
class PCL_NURBS_REGISTRATION_EXPORT VerticalTurn {
public:
  /** \param[in] angle radians, positive is up; kKittiVerticalAngle for KITTI */
  explicit VerticalTurn(double angle);

  /** \brief The raised point; one on the vertical, or not finite, as it is. */
  Eigen::Vector3f
  operator()(const Eigen::Vector3f& point) const;

private:
  double cosine_;
  double sine_;
};

/** \brief VerticalTurn of all points of a scan. */
PCL_NURBS_REGISTRATION_EXPORT void
correctVerticalAngle(ScanPoints& points, double angle);

/** \brief When each point was measured, 0 at the beginning of the scan and 1 at its
 * end, by its azimuth: for a laser that turns clockwise, seen from above, and begins
 * behind the vehicle, as KITTI's and most others.
 * \param[in] points in the frame x forward, y left, z up */
PCL_NURBS_REGISTRATION_EXPORT std::vector<float>
timesByAzimuth(const ScanPoints& points);

/** \brief Move the points of a scan to where they were seen from at one moment, for a
 * sensor that moved with constant velocity.
 * \param[in,out] points in the sensor's frame when each was measured; on return in its
 * frame at \a reference_time
 * \param[in] times per point, 0 at the beginning of the scan and 1 at its end
 * \param[in] motion of the sensor during the scan: its frame at the end in that at the
 * beginning
 * \param[in] reference_time 0 .. 1
 * \throws std::invalid_argument when there is not one time per point. O(points) */
PCL_NURBS_REGISTRATION_EXPORT void
deskew(ScanPoints& points,
       const std::vector<float>& times,
       const Eigen::Isometry3d& motion,
       double reference_time,
       int threads = 1);

} // namespace nurbs
} // namespace pcl
