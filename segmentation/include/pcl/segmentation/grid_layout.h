// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_geometry.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Coordinates in single precision, as clouds hold them. */
using PointList = std::vector<Eigen::Vector3f>;

/** \brief Which point of a cloud lies in which cell of a grid.
 * \ingroup segmentation
 */
struct GridLayout {
  GridGeometry geometry;
  std::vector<std::int32_t> cell_point; /**< index of the point per cell, -1 = none */
  std::size_t dropped = 0;              /**< readings that found no cell */
};

/** \brief Find the raster of an organized cloud: of a pinhole camera by least squares
 * (x / z linear in the column, y / z in the row), of a laser (angles linear in column
 * and row, or one angle per row), of a height field, whichever leaves the smallest
 * residual; a lattice when none of them is within half a cell. O(n).
 * \param[in] points width times height points, row by row; NaN = none
 * \param[in] width number of columns
 * \param[in] height number of rows
 * \param[in] threads number of threads; the result does not depend on it
 * \throws std::invalid_argument when sizes disagree or there is no thread
 */
PCL_NURBS_SEGMENTATION_EXPORT GridGeometry
estimateGridGeometry(const PointList& points, int width, int height, int threads = 1);

/** \brief Give scattered points a grid.
 *
 * Rings of a turning laser are found from the order of the points, else from the
 * clusters of their angles; other clouds get a uniform raster whose resolution follows
 * from their density. Of several points in a cell the nearest to the sensor stays;
 * others move over to a free cell beside it (their index does, never the point), and
 * the resolution rises until less than a tenth is dropped or there are 16 cells a
 * point. O(n) per resolution tried.
 * \param[in] points in the sensor's frame, for angular projections; not finite ones are
 * ignored
 * \param[in] projection perspective, spherical or plane; nothing = by the data: the
 * projection in which the depth is most nearly a function of the cell
 * \throws std::invalid_argument for a lattice */
PCL_NURBS_SEGMENTATION_EXPORT GridLayout
layOutScattered(const PointList& points, std::optional<GridProjection> projection);

} // namespace nurbs
} // namespace pcl
