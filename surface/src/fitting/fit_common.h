// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "ceres_cells.h"

#include <pcl/surface/nurbs/surface_fitter.h>

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief The points that are fitted and, apart, those that are only measured. */
class SplitPoints {
  FitPoints selected_; // unless all points are fitted as they are

public:
  /** \param[in] points must outlive this
   * \param[in] options tell which points are held out
   * \throws std::invalid_argument if there is nothing to fit, a value is not finite, a
   * count does not match or a sigma is not positive */
  SplitPoints(const FitPoints& points, const SurfaceFitOptions& options);

  SplitPoints(const SplitPoints&) = delete;
  SplitPoints&
  operator=(const SplitPoints&) = delete;

  /** Sigma is filled in, parameters kept if there were any. */
  const FitPoints& fitted;
  FitPoints held_out;
};

/** \brief Limits for Ceres from the options of a fit. */
CeresLimits
ceresLimits(const SurfaceFitOptions& options);

/** \brief Solve linear cell equations by the solver the options choose.
 * \param[in] points control points of each cell
 * \param[in] cells equations of the points
 * \param[in] fixed see solveLinearCells()
 * \param[in] options solver, fairness and threads
 * \param[in,out] unknowns (control points) x (right-hand sides)
 * \param[out] report converged, undetermined and message are set
 * \return false if the equations do not determine the unknowns */
bool
solveLinear(const CellPoints& points,
            std::vector<CellEquations> cells,
            const std::vector<bool>& fixed,
            const SurfaceFitOptions& options,
            Eigen::MatrixXd& unknowns,
            FitReport& report);

/** \brief Distances, held-out errors and foldovers of a finished fit. */
void
measureFit(const SplitPoints& points,
           const SurfaceFitOptions& options,
           SurfaceFit& fit);

} // namespace nurbs
} // namespace pcl
