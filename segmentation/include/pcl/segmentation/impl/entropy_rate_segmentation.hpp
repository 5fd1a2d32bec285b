// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/entropy_rate_segmentation.h>
#include <pcl/segmentation/impl/grid_segmentation.hpp>

#include <stdexcept>
#include <utility>

namespace pcl {

template <typename PointT>
void
EntropyRateSegmentation<PointT>::setConnectivity(int connectivity)
{
  nurbs::GridGraphOptions options = this->getGraphOptions();
  options.connectivity = connectivity;
  this->setGraphOptions(options);
}

template <typename PointT>
std::uint32_t
EntropyRateSegmentation<PointT>::performSegmentation(const nurbs::GridPoints& points,
                                                     nurbs::GridGraph& graph,
                                                     const SensorNoise& noise,
                                                     std::vector<std::uint32_t>& labels)
{
  borders_.clear();
  groups_.clear();
  objects_.clear();
  surface_labels_.clear();
  if (!input_->isOrganized())
    throw std::invalid_argument("EntropyRateSegmentation: the cloud is not organized; "
                                "segmentUnorganized() takes such a cloud");
  if (set_weights_) {
    set_weights_(graph, *input_);
    nurbs::requireValidWeights(graph);
  }
  const std::uint32_t count = groupPoints(points, graph, noise, labels);
  if (count == 0)
    throw std::invalid_argument("EntropyRateSegmentation: no neighbouring points, or "
                                "too few for a segment");
  borders_ = nurbs::segmentBorders(points, graph, labels, min_weight_);
  return count;
}

template <typename PointT>
std::uint32_t
EntropyRateSegmentation<PointT>::groupToObjects(
    const nurbs::GridPoints& points,
    const nurbs::GridGraph& graph,
    const SensorNoise& noise,
    const nurbs::SurfaceGroupingOptions& options,
    std::vector<std::uint32_t>& labels)
{
  nurbs::ObjectGrouping result =
      nurbs::groupObjects(points, graph, noise, options, object_options_);
  labels = std::move(result.labels);
  groups_ = std::move(result.surfaces);
  objects_ = std::move(result.objects);
  surface_labels_ = std::move(result.surface_labels);
  return static_cast<std::uint32_t>(objects_.size());
}

template <typename PointT>
std::uint32_t
EntropyRateSegmentation<PointT>::groupPoints(const nurbs::GridPoints& points,
                                             const nurbs::GridGraph& graph,
                                             const SensorNoise& noise,
                                             std::vector<std::uint32_t>& labels)
{
  if (mode_ != SUPERPIXELS) {
    nurbs::SurfaceGroupingOptions options = surfaces_;
    options.min_weight = min_weight_;
    options.min_size = this->getMinSegmentSize();
    options.threads = static_cast<int>(this->getNumberOfThreads());
    if (mode_ == OBJECTS)
      return groupToObjects(points, graph, noise, options, labels);
    return nurbs::groupSurfaces(points, graph, noise, options, labels, &groups_);
  }
  nurbs::SuperpixelOptions options = superpixels_;
  options.min_part = this->getMinSegmentSize();
  nurbs::Superpixels result =
      nurbs::gridSuperpixels(points, graph, min_weight_, options);
  labels = std::move(result.labels);
  return result.count;
}

} // namespace pcl

#define PCL_INSTANTIATE_EntropyRateSegmentation(T)                                     \
  template class PCL_NURBS_SEGMENTATION_EXPORT pcl::EntropyRateSegmentation<T>;
