// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/surface_grouping.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Options of groupObjects(). */
struct ObjectGroupingOptions {
  /** Surfaces that meet in a fold that opens towards the sensor by more than this
   * (radians) are parts of different objects. */
  double concave_angle = 0.26;
  /** Share of the border of two surfaces that must be convex or smooth. */
  double convex_share = 0.5;
  /** A convex border that is shorter than this times the square root of the points of
   * the smaller side (cells) joins nothing: things that touch in a point. */
  double least_border = 0.35;
};

/** \brief One object of groupObjects(). */
struct ObjectGroup {
  std::size_t size = 0;                /**< points */
  std::vector<std::uint32_t> surfaces; /**< labels of its surfaces, the largest first */
};

/** \brief Result of groupObjects(). */
struct ObjectGrouping {
  std::vector<std::uint32_t> labels;         /**< object per cell: 0 = none, 1.. */
  std::vector<ObjectGroup> objects;          /**< by label - 1, by decreasing size */
  std::vector<std::uint32_t> surface_labels; /**< as those of groupSurfaces() */
  std::vector<SurfaceGroup> surfaces;        /**< by surface label - 1 */
};

/** \brief Group the points of a grid into surfaces, and surfaces into objects.
 *
 * Where objects touch, their surfaces meet in a concave fold; the surfaces of one
 * object meet in convex ones (Hoffman and Richards, "Parts of recognition", Cognition
 * 18, 1984; for patches of voxels Stein, Schoeler, Papon and Woergoetter, "Object
 * Partitioning using Local Convexity", CVPR 2014). Here the parts of surfaces that one
 * polynomial describes are compared: along each piece of a common border a surface is
 * fitted to the points of either side, and with their normals n and mean points p the
 * piece is convex if (n_a - n_b) . (p_a - p_b) > 0. A hollow that one curved surface
 * explains better than two planes, as the inside of a bowl, is no fold. Parts are
 * joined, the most convex border first, while the convex share of the common border of
 * what was joined is large enough. Surfaces are joined within objects only. What no
 * surface explains goes to the object beside it. Things that a depth jump separates
 * are different objects.
 *
 * O(cells) beyond groupSurfaces(), the same result for any number of threads.
 * \param[in] points organized points
 * \param[in] graph their graph, with weights
 * \param[in] noise depth noise of the sensor
 * \param[in] surface_options as of groupSurfaces(); parts of a surface that others
 * separate are not joined, they may belong to different objects
 * \param[in] options see there
 * \throws std::invalid_argument as groupSurfaces(), and when an option is out of range
 * \ingroup segmentation */
PCL_NURBS_SEGMENTATION_EXPORT ObjectGrouping
groupObjects(const GridPoints& points,
             const GridGraph& graph,
             const SensorNoise& noise,
             const SurfaceGroupingOptions& surface_options = {},
             const ObjectGroupingOptions& options = {});

} // namespace nurbs
} // namespace pcl
