// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "fit_common.h"
#include "orthogonal_problem.h"

#include <pcl/surface/nurbs/surface_fitter.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Relative to the extent of the points: distances that count as none, and those
 * that only points without noise reach. */
constexpr double kRounding = 1e-12;
constexpr double kExactPoints = 1e-6;

/** How firmly the surface is kept from sliding along itself. A firm hand ends at the
 * most symmetric parameters. For a sphere these are stereographic, where the equations
 * lose a rank and convergence becomes slow; a light hand passes by on the side, but
 * overshoots where it is not needed. */
constexpr double kFirm = 1.0;
constexpr double kLight = 1e-4;

struct Attempt {
  SurfaceFit fit;
  CeresReport solved;
  double distance = 0.0; /**< RMS relative to the extent of the points */
};

Attempt
minimize(const NurbsSurface& start,
         const SplitPoints& points,
         const SurfaceFitOptions& options,
         double damping)
{
  const HomogeneousUnknowns unknowns(start, true);
  OrthogonalProblem problem(unknowns,
                            start,
                            points.fitted.positions,
                            points.fitted.parameters,
                            points.fitted.sigma,
                            options);
  problem.setDamping(damping);
  CeresLimits limits = ceresLimits(options);
  limits.trust_radius = 1e12; // the problem damps itself
  limits.dense_unknowns = 512;
  limits.negligible_cost = problem.costOf(kRounding);
  const CellPoints cells(start.knotsU(), start.knotsV(), points.fitted.parameters);
  Eigen::MatrixXd values = start.homogeneousPoints();
  Attempt result;
  result.solved = solveNonlinearCells(cells, problem, {}, limits, values);
  result.distance = std::sqrt(result.solved.final_cost / problem.costOf(1.0));
  result.fit.report.converged = result.solved.converged;
  result.fit.report.iterations = result.solved.iterations;
  if (!result.solved.converged)
    result.fit.report.message = "rational fit: " + result.solved.message;
  result.fit.parameters = problem.parameters();
  result.fit.surface = unknowns.surface(values);
  return result;
}

} // namespace

SurfaceFit
fitRational(const NurbsSurface& start,
            const FitPoints& points,
            const SurfaceFitOptions& options)
{
  const SplitPoints split(points, options);
  if (points.parameters.cols() == 0)
    throw std::invalid_argument("rational fit: points need parameters");
  Attempt best = minimize(start, split, options, kFirm);
  if (!best.solved.converged && best.distance < kExactPoints) {
    Attempt other = minimize(start, split, options, kLight);
    other.fit.report.iterations += best.fit.report.iterations;
    if (other.solved.usable && other.distance < best.distance)
      best = std::move(other);
  }
  best.fit.surface = extendedDomain(best.fit.surface, best.fit.parameters);
  measureFit(split, options, best.fit);
  return std::move(best.fit);
}

} // namespace nurbs
} // namespace pcl
