// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs_fitting.h>

#include <pcl/search/kdtree.h>

#include <pcl/console/print.h>

#include <algorithm>
#include <stdexcept>

namespace pcl {

template <typename PointT>
bool
NurbsFitting<PointT>::compute(nurbs::NurbsSurface& surface)
{
  report_ = nurbs::FitReport();
  used_.clear();
  if (!initCompute()) {
    report_.message = "no input cloud";
    PCL_ERROR("[pcl::NurbsFitting::compute] No input cloud.\n");
    return false;
  }
  bool done = false;
  try {
    nurbs::SegmentPoints segment;
    segment.points = gatherPoints();
    segment.planes = nurbs::localPlanes(gatherNeighbourhoods());
    used_noise_ = noise_ != 0.0 ? noise_ : segment.planes.sigma;
    if (noise_ != 0.0 || used_noise_ > 0.0)
      segment.points.sigma.setConstant(segment.points.positions.cols(), used_noise_);
    nurbs::SurfaceFit fit = nurbs::fitSegment(segment, options_);
    surface = std::move(fit.surface);
    report_ = std::move(fit.report);
    done = true;
  } catch (const std::logic_error& error) { // the kernel's contract and domain errors
    report_.message = error.what();
    PCL_ERROR("[pcl::NurbsFitting::compute] %s.\n", error.what());
  }
  deinitCompute();
  return done;
}

template <typename PointT>
nurbs::FitPoints
NurbsFitting<PointT>::gatherPoints()
{
  is_used_.assign(input_->size(), false);
  for (const auto index : *indices_) {
    if (static_cast<std::size_t>(index) >= input_->size())
      throw std::invalid_argument("an index is outside of the cloud");
    if (!(*input_)[index].getVector3fMap().allFinite())
      continue;
    used_.push_back(index);
    is_used_[index] = true;
  }
  const bool given = options_.parameterization == Parameterization::Given;
  if (given && static_cast<std::size_t>(given_.cols()) != input_->size())
    throw std::invalid_argument("one (u, v) per point of the cloud is needed");
  if (options_.parameterization == Parameterization::Grid && !input_->isOrganized())
    throw std::invalid_argument("the cloud is not organized");
  const auto count = static_cast<Eigen::Index>(used_.size());
  nurbs::FitPoints points;
  points.positions.resize(3, count);
  points.parameters.resize(2, given || input_->isOrganized() ? count : 0);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto index = used_[k];
    points.positions.col(k) = (*input_)[index].getVector3fMap().template cast<double>();
    if (given)
      points.parameters.col(k) = given_.col(index);
    else if (input_->isOrganized())
      points.parameters.col(k) << index % input_->width, index / input_->width;
  }
  return points;
}

template <typename PointT>
std::vector<Eigen::Matrix3Xd>
NurbsFitting<PointT>::gatherNeighbourhoods()
{
  constexpr std::size_t kMost = 1000;
  constexpr int kNeighbours = 16;
  std::vector<Eigen::Matrix3Xd> result;
  if (used_.size() <= kNeighbours)
    return result;
  if (!input_->isOrganized()) {
    if (!search_)
      search_.reset(new search::KdTree<PointT>(false));
    search_->setInputCloud(input_, IndicesConstPtr(new Indices(used_)));
  }
  const std::size_t step = (used_.size() + kMost - 1) / kMost;
  for (std::size_t k = 0; k < used_.size(); k += step) {
    Indices around;
    std::vector<float> distances;
    if (input_->isOrganized())
      around = gridNeighbours(used_[k]);
    else
      search_->nearestKSearch((*input_)[used_[k]], kNeighbours, around, distances);
    Eigen::Matrix3Xd points(3, around.size());
    for (std::size_t n = 0; n < around.size(); ++n)
      points.col(n) = (*input_)[around[n]].getVector3fMap().template cast<double>();
    result.push_back(std::move(points));
  }
  return result;
}

template <typename PointT>
Indices
NurbsFitting<PointT>::gridNeighbours(index_t centre) const
{
  constexpr int kRadius = 2;
  const int width = static_cast<int>(input_->width);
  const int height = static_cast<int>(input_->height);
  const int column = static_cast<int>(centre) % width;
  const int row = static_cast<int>(centre) / width;
  Indices result;
  for (int r = std::max(0, row - kRadius); r <= std::min(height - 1, row + kRadius);
       ++r)
    for (int c = std::max(0, column - kRadius);
         c <= std::min(width - 1, column + kRadius);
         ++c)
      if (is_used_[r * width + c])
        result.push_back(r * width + c);
  return result;
}

} // namespace pcl

#define PCL_INSTANTIATE_NurbsFitting(T)                                                \
  template class PCL_NURBS_SURFACE_EXPORT pcl::NurbsFitting<T>;
