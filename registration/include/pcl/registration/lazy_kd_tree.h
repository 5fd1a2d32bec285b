// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/common/point_tests.h>
#include <pcl/search/kdtree.h>

#include <limits>
#include <mutex>
#include <utility>

namespace pcl {

/** \brief A kd-tree that is built when it is first asked.
 *
 * pcl::Registration hands its target to a kd-tree before each alignment; one that finds
 * its pairs otherwise needs the tree only for getFitnessScore(), if at all. Places that
 * are not finite are infinitely far from everything.
 * \ingroup registration */
template <typename PointT>
class LazyKdTree : public search::KdTree<PointT> {
  using Base = search::KdTree<PointT>;
  using typename Base::IndicesConstPtr;
  using typename Base::PointCloudConstPtr;
  // void before PCL 1.14, bool from then on
  using Accepted = decltype(std::declval<Base&>().setInputCloud(PointCloudConstPtr()));

public:
  Accepted
  setInputCloud(const PointCloudConstPtr& cloud,
                const IndicesConstPtr& indices = IndicesConstPtr()) override
  {
    pending_ = cloud;
    pending_indices_ = indices;
    return Accepted(true);
  }

  using Base::nearestKSearch;

  int
  nearestKSearch(const PointT& point,
                 int k,
                 Indices& indices,
                 std::vector<float>& squares) const override
  {
    build();
    if (isXYZFinite(point))
      return Base::nearestKSearch(point, k, indices, squares);
    indices.assign(1, 0);
    squares.assign(1, std::numeric_limits<float>::infinity());
    return 0;
  }

private:
  void
  build() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!pending_)
      return;
    // Only a cache: what the tree answers is the same before and after.
    const_cast<LazyKdTree*>(this)->Base::setInputCloud(pending_, pending_indices_);
    pending_.reset();
  }

  mutable PointCloudConstPtr pending_;
  IndicesConstPtr pending_indices_;
  mutable std::mutex mutex_;
};

} // namespace pcl
