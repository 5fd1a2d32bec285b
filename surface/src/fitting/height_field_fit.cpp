// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "cell_values.h"
#include "fit_common.h"
#include "knot_search.h"
#include "orthogonal_problem.h"
#include "robust_loss.h"

#include <pcl/surface/nurbs/surface_fitter.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {
namespace {

/** (u, v, h) of every point, with the standard deviation of h. */
struct LocalPoints {
  Eigen::Matrix2Xd parameters;
  Eigen::VectorXd heights;
  Eigen::VectorXd sigma;
};

LocalPoints
toLocal(const HeightFieldFrame& frame, const FitPoints& points)
{
  const Eigen::Index n = points.positions.cols();
  LocalPoints result{Eigen::Matrix2Xd(2, n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Vector3d point = points.positions.col(k);
    const Eigen::Vector3d local = frame.toLocal(point);
    const double weight = frame.matrix().row(3).dot(local.homogeneous());
    if (!local.allFinite() || !(weight > 0.0))
      throw std::domain_error("height field: a point is behind the camera");
    result.parameters.col(k) = local.head<2>();
    result.heights(k) = local.z();
    result.sigma(k) = points.sigma(k) / frame.derivativeByHeight(point, weight).norm();
  }
  return result;
}

/** Rows of the linear problem in the heights.
 * \param[in] robust weight of each point; empty for 1 */
PointRows
heightRows(const CellPoints& cells,
           const LocalPoints& local,
           const Eigen::VectorXd& robust)
{
  const Eigen::Index n = local.heights.size();
  PointRows rows;
  rows.gram.resize(n, 1);
  rows.moments.resize(n, 1);
  rows.squares.resize(n, 1);
  for (Eigen::Index k = 0; k < n; ++k) {
    const int point = cells.order[static_cast<std::size_t>(k)];
    const double weight = (robust.size() != 0 ? robust(point) : 1.0) /
                          (local.sigma(point) * local.sigma(point));
    rows.gram(k, 0) = weight;
    rows.moments(k, 0) = weight * local.heights(point);
    rows.squares(k, 0) = weight * local.heights(point) * local.heights(point);
  }
  return rows;
}

/** Weights rho' of residuals. While the residuals are still larger than the noise (the
 * start is a plain least-squares fit), the loss is stretched to their median, so that a
 * redescending loss cannot lock on to the wrong points. */
Eigen::VectorXd
robustWeights(const Eigen::VectorXd& residual, const SurfaceFitOptions& options)
{
  constexpr double kNormalQuartile = 0.6744897501960817; // median of |N(0, 1)|
  std::vector<double> sizes(static_cast<std::size_t>(residual.size()));
  for (std::size_t k = 0; k < sizes.size(); ++k)
    sizes[k] = std::abs(residual(static_cast<Eigen::Index>(k)));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double scale = options.loss_scale * std::max(1.0, *middle / kNormalQuartile);
  return residual.unaryExpr(
      [&](double r) { return evaluateLoss(options.loss, scale, r * r).slope; });
}

/** Heights that fit best along the direction of h, by iteratively reweighted least
 * squares if there is a loss. */
Eigen::VectorXd
solveHeights(const KnotVector& knots_u,
             const KnotVector& knots_v,
             const LocalPoints& local,
             const SurfaceFitOptions& options,
             FitReport& report)
{
  constexpr int kMostRounds = 10;
  constexpr double kSteadyWeights = 2e-3;
  const int rounds = options.loss == RobustLoss::Squared
                         ? 0
                         : std::min(options.max_iterations, kMostRounds);
  const CellPoints cells(knots_u, knots_v, local.parameters);
  Eigen::MatrixXd unknowns = Eigen::MatrixXd::Zero(cells.numControlPoints(), 1);
  Eigen::VectorXd robust;
  const auto solve = [&](const SurfaceFitOptions& how) {
    std::vector<CellEquations> equations =
        reduceCells(cells, heightRows(cells, local, robust), options.threads);
    if (!solveLinear(cells, std::move(equations), {}, how, unknowns, report))
      throw std::domain_error("height field: " + report.message);
    ++report.iterations;
  };
  // Rounds that only find the weights need no more than the quickest solution.
  SurfaceFitOptions quick = options;
  quick.linear_solver = LinearSolver::Cholesky;
  for (int round = 0; round < rounds; ++round) {
    solve(quick);
    const Eigen::VectorXd previous = std::move(robust);
    robust = robustWeights(
        (local.heights - evaluateCells(cells, unknowns)).cwiseQuotient(local.sigma),
        options);
    if (previous.size() != 0 && (robust - previous).cwiseAbs().mean() < kSteadyWeights)
      break;
  }
  solve(options);
  return unknowns.col(0);
}

} // namespace

ParameterBox
ParameterBox::around(const Eigen::Matrix2Xd& parameters)
{
  constexpr double kRelativeExtent = 1e-6;
  ParameterBox box{parameters.rowwise().minCoeff(), parameters.rowwise().maxCoeff()};
  const double largest = (box.high - box.low).maxCoeff();
  const double scale = largest > 0.0 ? largest : 1.0 + box.low.cwiseAbs().maxCoeff();
  for (int d = 0; d < 2; ++d)
    if (box.high(d) - box.low(d) < kRelativeExtent * scale) {
      box.low(d) -= 0.5 * kRelativeExtent * scale;
      box.high(d) += 0.5 * kRelativeExtent * scale;
    }
  return box;
}

SurfaceFit
fitHeightField(const HeightFieldFrame& frame,
               const KnotVector& knots_u,
               const KnotVector& knots_v,
               const FitPoints& points,
               const SurfaceFitOptions& options)
{
  SplitPoints split(points, options);
  LocalPoints local = toLocal(frame, split.fitted);
  if (split.held_out.positions.cols() > 0)
    split.held_out.parameters = toLocal(frame, split.held_out).parameters;
  SurfaceFit fit;
  Eigen::MatrixXd heights =
      solveHeights(knots_u, knots_v, local, options, fit.report).transpose();
  fit.surface = frame.surface(knots_u, knots_v, heights.transpose());
  if (options.distance == FitDistance::Parametric) {
    fit.parameters = std::move(local.parameters);
  }
  else {
    const HeightUnknowns unknowns(frame, knots_u, knots_v);
    OrthogonalProblem problem(unknowns,
                              fit.surface,
                              split.fitted.positions,
                              local.parameters,
                              split.fitted.sigma,
                              options);
    const CellPoints cells(knots_u, knots_v, local.parameters);
    const CeresReport solved =
        solveNonlinearCells(cells, problem, {}, ceresLimits(options), heights);
    fit.report.converged = solved.converged;
    fit.report.iterations += solved.iterations;
    fit.report.message = solved.usable ? "" : solved.message;
    fit.surface = unknowns.surface(heights);
    fit.parameters = problem.parameters();
  }
  if (options.measure)
    measureFit(split, options, fit);
  return fit;
}

SurfaceKnots
chooseHeightFieldKnots(const HeightFieldFrame& frame,
                       const FitPoints& points,
                       const KnotSearchOptions& options,
                       FitReport& report,
                       const SurfaceKnots* start)
{
  const SplitPoints split(points, SurfaceFitOptions());
  const LocalPoints local = toLocal(frame, split.fitted);
  return searchBinned(local.parameters,
                      local.heights,
                      local.sigma,
                      points.sigma.size() != 0,
                      options,
                      start,
                      report);
}

} // namespace nurbs
} // namespace pcl
