// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/surface_reconstruction.h>

#include <cstddef>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief How well patches represent the points of a cloud. Distances are orthogonal,
 * in metres, over the held-out points of the patches (over all their points if none
 * were held out). */
struct ReconstructionStatistics {
  std::size_t covered_points = 0;  /**< within tolerance of their patch */
  std::size_t measured_points = 0; /**< points the distances are taken over */
  double rmse = 0.0;
  double mean = 0.0;
  double p95 = 0.0;
  double max = 0.0;
};

/** \brief Sum up the distances of a reconstruction. O(cells). */
PCL_NURBS_MAPPING_EXPORT ReconstructionStatistics
summarize(const Reconstruction& reconstruction);

/** \brief Value of the nearest labelled point for each query, NaN where a query's
 * nearest point is further away than \a radius: colours a mesh by deviation.
 * \param[in] points the cloud
 * \param[in] reconstruction distances per cell
 * \param[in] queries places on the surfaces, metres
 * \param[in] radius metres */
PCL_NURBS_MAPPING_EXPORT std::vector<double>
nearestDistances(const GridPoints& points,
                 const Reconstruction& reconstruction,
                 const std::vector<Eigen::Vector3d>& queries,
                 double radius);

} // namespace nurbs
} // namespace pcl
