// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/voxel_map.h>

namespace pcl {
namespace nurbs {

/** What a target looks like around a place. */
struct LocalSurface {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); // zero where it is not flat
  /** Where it is an edge, its direction, along which nothing is held; else zero. */
  Eigen::Vector3d line = Eigen::Vector3d::Zero();
  /** Covariance of a plane's normal. */
  Eigen::Matrix3d normal_covariance = Eigen::Matrix3d::Zero();
  /** Whether it has depth in all directions, as leaves have: neither a plane nor the
   * edge between two, along which points may slide. */
  bool scattered = false;
  /** Where it is scattered, how much of a motion takes a point away from the target:
   * none, where others follow in its direction. */
  Eigen::Matrix3d held = Eigen::Matrix3d::Zero();

  bool
  flat() const
  {
    return !normal.isZero(0.0);
  }

  bool
  edge() const
  {
    return !line.isZero(0.0);
  }
};

/** The plane through points with these moments, when they lie on one. */
LocalSurface
localSurface(const PointMoments& moments);

} // namespace nurbs
} // namespace pcl
