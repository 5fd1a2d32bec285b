// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/cloud_organizer.h>
#include <pcl/segmentation/grid_segmentation.h>

#include <pcl/memory.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl {

/** \brief Segment a cloud that need not be organized: CloudOrganizer gives it a raster,
 * and the segments hold the indices of its own points. Points that found no cell of
 * their own (CloudOrganizer::getNumDropped()) are in no segment.
 * \param[in] cloud any cloud
 * \param[in,out] segmentation segments the organized cloud, which is its input
 *                afterwards: getLabelCloud() and the like refer to that
 * \param[out] segments point indices per segment, by decreasing size; empty on failure
 * \return whether there are segments
 * \ingroup segmentation
 */
template <typename PointT>
bool
segmentUnorganized(const typename pcl::PointCloud<PointT>::ConstPtr& cloud,
                   GridSegmentation<PointT>& segmentation,
                   std::vector<PointIndices>& segments)
{
  segments.clear();
  CloudOrganizer<PointT> organizer;
  organizer.setNumberOfThreads(segmentation.getNumberOfThreads());
  if (cloud)
    organizer.setInputCloud(cloud);
  const auto organized = pcl::make_shared<pcl::PointCloud<PointT>>();
  if (!organizer.organize(*organized))
    return false;
  segmentation.setInputCloud(organized);
  segmentation.setGeometry(organizer.getGeometry());
  segmentation.segment(segments);
  const std::vector<std::int32_t>& point_of_cell = organizer.getCellPoints();
  for (PointIndices& segment : segments) {
    for (index_t& index : segment.indices)
      index = point_of_cell[static_cast<std::size_t>(index)];
    std::sort(segment.indices.begin(), segment.indices.end());
  }
  return !segments.empty();
}

} // namespace pcl
