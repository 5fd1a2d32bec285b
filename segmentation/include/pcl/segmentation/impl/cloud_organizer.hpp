// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/cloud_organizer.h>

#include <pcl/console/print.h>

#include <algorithm>
#include <limits>

namespace pcl {

template <typename PointT>
bool
CloudOrganizer<PointT>::organize(PointCloud& output)
{
  output.clear();
  layout_ = nurbs::GridLayout();
  if (!initCompute()) {
    PCL_ERROR("[pcl::CloudOrganizer::organize] No input cloud.\n");
    return false;
  }
  if (input_->isOrganized())
    passThrough();
  else
    layOut();
  PointT none = PointT();
  none.x = none.y = none.z = std::numeric_limits<float>::quiet_NaN();
  const auto& cells = layout_.cell_point;
  output.header = input_->header;
  output.sensor_origin_ = input_->sensor_origin_;
  output.sensor_orientation_ = input_->sensor_orientation_;
  output.resize(cells.size(), none);
  output.width = static_cast<std::uint32_t>(layout_.geometry.width);
  output.height = static_cast<std::uint32_t>(layout_.geometry.height);
  output.is_dense = false;
  bool any = false;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i] >= 0) {
      output[i] = (*input_)[static_cast<std::size_t>(cells[i])];
      any = true;
    }
  deinitCompute();
  if (!any) {
    PCL_ERROR("[pcl::CloudOrganizer::organize] No finite point in the input.\n");
    output.clear();
  }
  return any;
}

template <typename PointT>
void
CloudOrganizer<PointT>::passThrough()
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  nurbs::PointList points(input_->size(), Eigen::Vector3f::Constant(nan));
  layout_.cell_point.assign(input_->size(), -1);
  for (const auto index : *indices_) {
    const auto i = static_cast<std::size_t>(index);
    if (!(*input_)[i].getVector3fMap().allFinite())
      continue;
    points[i] = (*input_)[i].getVector3fMap();
    layout_.cell_point[i] = index;
  }
  layout_.geometry =
      nurbs::estimateGridGeometry(points,
                                  static_cast<int>(input_->width),
                                  static_cast<int>(input_->height),
                                  static_cast<int>(std::max(threads_, 1U)));
}

template <typename PointT>
void
CloudOrganizer<PointT>::layOut()
{
  nurbs::PointList points;
  points.reserve(indices_->size());
  for (const auto index : *indices_)
    points.emplace_back((*input_)[static_cast<std::size_t>(index)].getVector3fMap());
  std::optional<GridProjection> projection;
  switch (projection_) {
  case SPHERICAL:
    projection = GridProjection::spherical;
    break;
  case PERSPECTIVE:
    projection = GridProjection::perspective;
    break;
  case PLANE:
    projection = GridProjection::plane;
    break;
  case AUTO:
    break;
  }
  layout_ = nurbs::layOutScattered(points, projection);
  for (std::int32_t& point : layout_.cell_point)
    if (point >= 0)
      point = static_cast<std::int32_t>((*indices_)[static_cast<std::size_t>(point)]);
}

} // namespace pcl

#define PCL_INSTANTIATE_CloudOrganizer(T)                                              \
  template class PCL_NURBS_SEGMENTATION_EXPORT pcl::CloudOrganizer<T>;
