// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_layout.h>
#include <pcl/segmentation/grid_segmentation.h>

#include <pcl/console/print.h>

#include <stdexcept>

namespace pcl {

template <typename PointT>
void
GridSegmentation<PointT>::segment(std::vector<PointIndices>& segments)
{
  segments.clear();
  labels_.clear();
  count_ = 0;
  if (!initCompute()) {
    PCL_ERROR("[pcl::GridSegmentation::segment] No input cloud.\n");
    return;
  }
  try {
    const nurbs::GridPoints points = gatherPoints();
    used_noise_ =
        noise_ ? *noise_ : SensorNoise::estimate(points, graph_options_.threads);
    graph_.build(points, used_noise_, graph_options_);
    graph_.setDistanceWeights(graph_options_.threads);
    count_ = performSegmentation(points, graph_, used_noise_, labels_);
  } catch (const std::invalid_argument& error) {
    PCL_ERROR("[pcl::GridSegmentation::segment] %s\n", error.what());
    labels_.clear();
  }
  segments.resize(count_);
  for (PointIndices& segment : segments)
    segment.header = input_->header;
  for (std::size_t i = 0; i < labels_.size(); ++i)
    if (labels_[i] != 0)
      segments[labels_[i] - 1].indices.push_back(static_cast<index_t>(i));
  deinitCompute();
}

template <typename PointT>
nurbs::GridPoints
GridSegmentation<PointT>::gatherPoints() const
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  nurbs::GridPoints points;
  points.x.assign(input_->size(), nan);
  points.y.assign(input_->size(), nan);
  points.z.assign(input_->size(), nan);
  for (const auto index : *indices_) {
    const auto cell = static_cast<std::size_t>(index);
    const PointT& point = (*input_)[cell];
    points.x[cell] = point.x;
    points.y[cell] = point.y;
    points.z[cell] = point.z;
  }
  points.geometry = geometry_ ? *geometry_ : estimateGeometry(points);
  nurbs::completeGridPoints(points, graph_options_.threads);
  return points;
}

template <typename PointT>
GridGeometry
GridSegmentation<PointT>::estimateGeometry(const nurbs::GridPoints& points) const
{
  nurbs::PointList list;
  list.reserve(points.x.size());
  for (std::size_t cell = 0; cell < points.x.size(); ++cell)
    list.push_back(points.point(cell));
  return nurbs::estimateGridGeometry(list,
                                     static_cast<int>(input_->width),
                                     static_cast<int>(input_->height),
                                     graph_options_.threads);
}

template <typename PointT>
pcl::PointCloud<pcl::PointXYZL>::Ptr
GridSegmentation<PointT>::getLabelCloud() const
{
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZL>>();
  if (labels_.empty())
    return cloud;
  cloud->resize(labels_.size());
  cloud->width = input_->width;
  cloud->height = input_->height;
  cloud->is_dense = input_->is_dense;
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    (*cloud)[i].getVector3fMap() = (*input_)[i].getVector3fMap();
    (*cloud)[i].label = labels_[i];
  }
  return cloud;
}

template <typename PointT>
pcl::PointCloud<pcl::PointXYZRGB>::Ptr
GridSegmentation<PointT>::getColoredCloud() const
{
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZRGB>>();
  if (labels_.empty())
    return cloud;
  cloud->resize(labels_.size());
  cloud->width = input_->width;
  cloud->height = input_->height;
  cloud->is_dense = input_->is_dense;
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    const RGB color = nurbs::labelColor(labels_[i]);
    (*cloud)[i].getVector3fMap() = (*input_)[i].getVector3fMap();
    (*cloud)[i].rgba = color.rgba;
  }
  return cloud;
}

template <typename PointT>
std::uint32_t
ConnectedGroupsSegmentation<PointT>::performSegmentation(
    const nurbs::GridPoints& points,
    nurbs::GridGraph& graph,
    const SensorNoise& noise,
    std::vector<std::uint32_t>& labels)
{
  nurbs::ConnectedGroupsOptions options = options_;
  options.min_size = this->getMinSegmentSize();
  options.threads = static_cast<int>(this->getNumberOfThreads());
  return nurbs::connectedGroups(points, graph, noise, options, labels);
}

} // namespace pcl

#define PCL_INSTANTIATE_GridSegmentation(T)                                            \
  template class PCL_NURBS_SEGMENTATION_EXPORT pcl::GridSegmentation<T>;
#define PCL_INSTANTIATE_ConnectedGroupsSegmentation(T)                                 \
  template class PCL_NURBS_SEGMENTATION_EXPORT pcl::ConnectedGroupsSegmentation<T>;
