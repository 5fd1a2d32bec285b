// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/nurbs_reconstruction.h>
#include <pcl/mapping/stop_watch.h>
#include <pcl/segmentation/impl/cloud_organizer.hpp>
#include <pcl/segmentation/impl/entropy_rate_segmentation.hpp>

#include <pcl/console/print.h>

#include <stdexcept>

namespace pcl {

template <typename PointT>
bool
NurbsReconstruction<PointT>::reconstruct(nurbs::SurfaceModel& model)
{
  model = {};
  result_ = {};
  seconds_ = {};
  num_segments_ = 0;
  if (!organize() || !segment())
    return false;
  nurbs::StopWatch watch;
  try {
    const nurbs::GridPoints points = nurbs::toGridPoints(*organized_, used_geometry_);
    result_ =
        nurbs::reconstructSurfaces(points, segment_labels_, used_noise_, options_);
  } catch (const std::logic_error& error) { // std::invalid_argument, std::domain_error
    PCL_ERROR("[pcl::NurbsReconstruction::reconstruct] %s\n", error.what());
    return false;
  }
  // Fits and trims of different segments run side by side: share the wall-clock time.
  const double wall = watch.lap();
  const double busy = result_.fit_seconds + result_.trim_seconds;
  seconds_.fit = busy > 0.0 ? wall * result_.fit_seconds / busy : wall;
  seconds_.trim = wall - seconds_.fit;
  model = result_.model;
  model.frame_id = input_->header.frame_id;
  if (model.patches.empty())
    PCL_ERROR("[pcl::NurbsReconstruction::reconstruct] No segment is a surface.\n");
  return !model.patches.empty();
}

template <typename PointT>
bool
NurbsReconstruction<PointT>::organize()
{
  nurbs::StopWatch watch;
  if (geometry_ && input_ && input_->isOrganized() && !indices_) {
    *organized_ = *input_;
    used_geometry_ = *geometry_;
  }
  else {
    CloudOrganizer<PointT> organizer;
    organizer.setInputCloud(input_);
    if (indices_)
      organizer.setIndices(indices_);
    organizer.setProjection(projection_);
    organizer.setNumberOfThreads(numberOfThreads());
    if (!organizer.organize(*organized_))
      return false;
    used_geometry_ = geometry_ ? *geometry_ : organizer.getGeometry();
  }
  seconds_.organize = watch.lap();
  return true;
}

template <typename PointT>
bool
NurbsReconstruction<PointT>::segment()
{
  nurbs::StopWatch watch;
  typename Segmentation::Ptr segmentation = segmentation_;
  if (!segmentation) {
    segmentation.reset(new EntropyRateSegmentation<PointT>);
    segmentation->setMinSegmentSize(
        static_cast<std::size_t>(std::max(options_.min_patch_points, 1)));
  }
  segmentation->setInputCloud(organized_);
  segmentation->setNumberOfThreads(numberOfThreads());
  segmentation->setGeometry(used_geometry_);
  if (noise_)
    segmentation->setSensorNoise(*noise_);
  std::vector<PointIndices> segments;
  segmentation->segment(segments);
  segment_labels_ = segmentation->getLabels();
  used_noise_ = segmentation->getUsedNoise();
  num_segments_ = segments.size();
  seconds_.segment = watch.lap();
  if (segments.empty())
    PCL_ERROR("[pcl::NurbsReconstruction::reconstruct] No segment found.\n");
  return !segments.empty();
}

} // namespace pcl

#define PCL_INSTANTIATE_NurbsReconstruction(T)                                         \
  template class PCL_NURBS_MAPPING_EXPORT pcl::NurbsReconstruction<T>;
