// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "sample_grid.h"

#include <pcl/surface/nurbs/fit_options.h>
#include <pcl/surface/nurbs/knot_vector.h>
#include <pcl/surface/nurbs/surface_fitter.h>

#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Degrees and knots that the samples pay for. */
struct KnotSearchResult {
  KnotVector knots_u;
  KnotVector knots_v;
  double criterion = 0.0;
  std::vector<SalientRegion> salient; /**< what still does not look like noise */
};

/** \brief Value of a model criterion.
 * \param[in] criterion which one
 * \param[in] samples number of independent values n
 * \param[in] rss weighted residual sum of squares; in units of the noise for KnownNoise
 * \param[in] parameters number of stored values k */
double
modelCriterion(ModelCriterion criterion, double samples, double rss, double parameters);

/** \brief Choose degrees and knots for scalar or vector samples over a rectangle.
 *
 * From one bilinear span: residuals are scored against their noise, group testing finds
 * the salient bins, knots are added where they are (or a degree is raised) as long as
 * the criterion falls, and knots it no longer needs are taken out again.
 * \param[in] samples binned points
 * \param[in] noise stated standard deviation of a value of unit weight, 0 if unknown;
 * what the samples themselves show comes first, except for KnownNoise
 * \param[in] options limits and criterion
 * \param[in] start model to begin with instead, over the same domain; null for none */
KnotSearchResult
searchKnots(const SampleGrid& samples,
            double noise,
            const KnotSearchOptions& options,
            const SurfaceKnots* start = nullptr);

/** \brief Bin points over the box of their parameters and search.
 * \param[in] parameters (u, v) of each point
 * \param[in] values one row per point
 * \param[in] sigma standard deviation of each point's values
 * \param[in] options limits and criterion
 * \param[in] start see searchKnots()
 * \param[out] report criterion and remaining salient regions are set
 * \throws std::invalid_argument for KnownNoise without a known sigma */
SurfaceKnots
searchBinned(const Eigen::Matrix2Xd& parameters,
             const Eigen::MatrixXd& values,
             const Eigen::VectorXd& sigma,
             bool sigma_is_known,
             const KnotSearchOptions& options,
             const SurfaceKnots* start,
             FitReport& report);

} // namespace nurbs
} // namespace pcl
