// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "robust_plane.h"

#include <pcl/segmentation/grid_points.h>
#include <pcl/surface/nurbs/height_field_frame.h>

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief How the lattice corners of a grid get their (u, v). */
enum class CornerRule {
  Grid,   /**< (u, v) is (column, row) */
  View,   /**< all points of a ray have the same (u, v): the frame looks from the sensor
           */
  Surface /**< where the ray through the corner meets the surface */
};

/** \brief A frame to try for a segment. */
struct FrameCandidate {
  HeightFieldFrame frame;
  CornerRule corners = CornerRule::Surface;
  /** Where the surface is looked for: points outside are not fitted, for they are of
   * other surfaces. */
  std::optional<Slab> slab;
};

/** \brief A frame that is found when it is its turn: most segments need but the first.
 */
struct FrameProposal {
  CornerRule corners;
  /** Nothing when the frame would not differ from an earlier one or does not suit. */
  std::function<std::optional<FrameCandidate>()> find;
};

/** \brief Frames in which the points of a segment, or those of its largest sheet, may
 * be a scalar field, best guess first: a camera's pixels, then for long segments the
 * same view turned along them, then base planes; for a laser the base plane, that of
 * the largest sheet, then the pinhole view along the mean direction; a map's own plane,
 * for all points, then for the largest sheet; for a mere lattice the base plane, then
 * the robust one.
 * \param[in] geometry raster of the cloud; referred to
 * \param[in] positions points of the segment, metres; referred to
 * \param[in] noise standard deviation of their depth, metres */
std::vector<FrameProposal>
proposeFrames(const GridGeometry& geometry,
              const Eigen::Matrix3Xd& positions,
              double noise);

} // namespace nurbs
} // namespace pcl
