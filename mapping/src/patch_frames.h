// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_points.h>
#include <pcl/surface/nurbs/height_field_frame.h>

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A frame to try for a segment. */
struct FrameCandidate {
  HeightFieldFrame frame;
  /** Whether (u, v) of a cell is its (column, row), so that lattice corners are exact.
   */
  bool grid_parameters = false;
};

/** \brief Frames in which the points of a segment may be a scalar field, best guess
 * first: a camera's pixels; for a laser a base plane, then the pinhole view along the
 * mean direction; a map's own plane; for a mere lattice the base plane. \param[in]
 * geometry raster of the cloud \param[in] positions points of the segment, metres */
std::vector<FrameCandidate>
candidateFrames(const GridGeometry& geometry, const Eigen::Matrix3Xd& positions);

} // namespace nurbs
} // namespace pcl
