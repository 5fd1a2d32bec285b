// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_layout.h>

#include <pcl/pcl_base.h>
#include <pcl/point_cloud.h>

#include <vector>

namespace pcl {

/** \brief Gives a cloud the raster of a sensor, so that grid algorithms can work on it.
 *
 * An organized cloud passes through and its raster is recognised (pinhole camera with
 * its focal lengths and centre, laser, height field, or a mere lattice). Other clouds
 * are laid out: rings and azimuths of a turning laser, a uniform spherical or pinhole
 * raster, or a height field over the plane of largest extent. No point is moved; cells
 * without a point hold NaN.
 *
 * \code
 * pcl::CloudOrganizer<pcl::PointXYZ> organizer;
 * organizer.setInputCloud (cloud);
 * pcl::PointCloud<pcl::PointXYZ> organized;
 * organizer.organize (organized);
 * \endcode
 * \ingroup segmentation
 */
template <typename PointT>
class CloudOrganizer : public PCLBase<PointT> {
  using PCLBase<PointT>::input_;
  using PCLBase<PointT>::indices_;
  using PCLBase<PointT>::initCompute;
  using PCLBase<PointT>::deinitCompute;

public:
  using Ptr = shared_ptr<CloudOrganizer<PointT>>;
  using ConstPtr = shared_ptr<const CloudOrganizer<PointT>>;
  using PointCloud = pcl::PointCloud<PointT>;

  /** \brief Projection of a cloud that is not organized. */
  enum Projection { AUTO, SPHERICAL, PERSPECTIVE, PLANE };

  void
  setProjection(Projection projection)
  {
    projection_ = projection;
  }

  Projection
  getProjection() const
  {
    return projection_;
  }

  /** \brief Number of threads (default 1); the result does not depend on it. */
  void
  setNumberOfThreads(unsigned int threads)
  {
    threads_ = threads;
  }

  /** \brief Organize the input cloud (its indices, when set).
   * \param[out] output organized cloud, not dense; empty on failure
   * \return whether there was a finite point to organize
   */
  bool
  organize(PointCloud& output);

  /** \brief Raster of the last output. */
  const GridGeometry&
  getGeometry() const
  {
    return layout_.geometry;
  }

  /** \brief Per cell of the last output, the index of its point in the input cloud, or
   * -1. */
  const std::vector<std::int32_t>&
  getCellPoints() const
  {
    return layout_.cell_point;
  }

  /** \brief Number of finite points that found no cell. */
  std::size_t
  getNumDropped() const
  {
    return layout_.dropped;
  }

  PCL_MAKE_ALIGNED_OPERATOR_NEW

private:
  void
  passThrough();

  void
  layOut();

  Projection projection_ = AUTO;
  unsigned int threads_ = 1;
  nurbs::GridLayout layout_;
};

} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl/segmentation/impl/cloud_organizer.hpp>
#endif
