// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "fit_common.h"

#include "fairness.h"
#include "foot_point.h"
#include "normal_equations.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace pcl {
namespace nurbs {
namespace {

void
requireValid(const FitPoints& points, const SurfaceFitOptions& options)
{
  const Eigen::Index n = points.positions.cols();
  if (n == 0)
    throw std::invalid_argument("surface fit: there are no points");
  if (points.parameters.cols() != 0 && points.parameters.cols() != n)
    throw std::invalid_argument("surface fit: one (u, v) per point is needed");
  if (points.sigma.size() != 0 && points.sigma.size() != n)
    throw std::invalid_argument("surface fit: one sigma per point is needed");
  if (!points.positions.allFinite() || !points.parameters.allFinite() ||
      !points.sigma.allFinite())
    throw std::invalid_argument("surface fit: a point is not finite");
  if (points.sigma.size() != 0 && !(points.sigma.minCoeff() > 0.0))
    throw std::invalid_argument("surface fit: a sigma is not positive");
  if (options.threads < 1 || options.max_iterations < 1 ||
      !(options.tolerance >= 0.0) || !(options.fairness >= 0.0) ||
      !(options.loss_scale > 0.0) || options.hold_out_every < 0 ||
      options.hold_out_every == 1)
    throw std::invalid_argument("surface fit: an option is out of range");
}

/** Whether no copy is needed: a million points take 48 MB. */
bool
isFittedAsItIs(const FitPoints& points, const SurfaceFitOptions& options)
{
  return options.hold_out_every == 0 && points.sigma.size() != 0;
}

FitPoints
select(const FitPoints& points, const std::vector<Eigen::Index>& which)
{
  FitPoints result;
  const auto n = static_cast<Eigen::Index>(which.size());
  result.positions.resize(3, n);
  result.sigma.setOnes(n);
  result.parameters.resize(2, points.parameters.cols() != 0 ? n : 0);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index from = which[static_cast<std::size_t>(k)];
    result.positions.col(k) = points.positions.col(from);
    if (points.parameters.cols() != 0)
      result.parameters.col(k) = points.parameters.col(from);
    if (points.sigma.size() != 0)
      result.sigma(k) = points.sigma(from);
  }
  return result;
}

/** Knot cells whose normals at the middle and near the corners, or on both sides of a
 * border with the next cell, point away from each other. */
int
countFoldovers(const NurbsSurface& surface)
{
  constexpr double kNear = 0.02; // of a cell
  const std::vector<double> u = surface.knotsU().breaks();
  const std::vector<double> v = surface.knotsV().breaks();
  int count = 0;
  for (std::size_t i = 0; i + 1 < u.size(); ++i)
    for (std::size_t j = 0; j + 1 < v.size(); ++j) {
      const auto normalAt = [&](double a, double b) {
        const SurfaceJet1 jet = surface.evaluateJet1(u[i] + a * (u[i + 1] - u[i]),
                                                     v[j] + b * (v[j + 1] - v[j]));
        return Eigen::Vector3d(jet.du.cross(jet.dv));
      };
      const Eigen::Vector3d middle = normalAt(0.5, 0.5);
      bool folded = false;
      for (double a : {kNear, 1.0 - kNear})
        for (double b : {kNear, 1.0 - kNear})
          folded = folded || middle.dot(normalAt(a, b)) < 0.0;
      if (i + 2 < u.size())
        folded =
            folded || normalAt(1.0 - kNear, 0.5).dot(normalAt(1.0 + kNear, 0.5)) < 0.0;
      if (j + 2 < v.size())
        folded =
            folded || normalAt(0.5, 1.0 - kNear).dot(normalAt(0.5, 1.0 + kNear)) < 0.0;
      count += folded ? 1 : 0;
    }
  return count;
}

/** Number of control points on which the points do not act at all. */
int
countUndetermined(const CellPoints& points, const std::vector<CellEquations>& cells)
{
  constexpr double kNegligible = 1e-12;
  Eigen::VectorXd information = Eigen::VectorXd::Zero(points.numControlPoints());
  for (int cell = 0; cell < points.numCells(); ++cell) {
    const std::vector<int> controls = points.controls(cell);
    const auto diagonal = cells[static_cast<std::size_t>(cell)].gram.diagonal();
    for (std::size_t k = 0; k < controls.size(); ++k)
      information(controls[k]) += diagonal(static_cast<Eigen::Index>(k));
  }
  return static_cast<int>(
      (information.array() <= kNegligible * information.maxCoeff()).count());
}

double
totalInformation(const std::vector<CellEquations>& cells)
{
  double sum = 0.0;
  for (const CellEquations& cell : cells)
    sum += cell.gram.trace();
  return sum;
}

} // namespace

SplitPoints::SplitPoints(const FitPoints& points, const SurfaceFitOptions& options)
    : fitted(isFittedAsItIs(points, options) ? points : selected_)
{
  requireValid(points, options);
  if (&fitted == &points)
    return;
  std::vector<Eigen::Index> fit;
  std::vector<Eigen::Index> hold;
  for (Eigen::Index k = 0; k < points.positions.cols(); ++k) {
    const bool held = options.hold_out_every > 0 &&
                      k % options.hold_out_every == options.hold_out_every - 1;
    (held ? hold : fit).push_back(k);
  }
  selected_ = select(points, fit);
  held_out = select(points, hold);
}

CeresLimits
ceresLimits(const SurfaceFitOptions& options)
{
  CeresLimits limits;
  limits.threads = options.threads;
  limits.max_iterations = options.max_iterations;
  limits.function_tolerance = options.tolerance;
  limits.parameter_tolerance = 0.01 * options.tolerance;
  return limits;
}

bool
solveLinear(const CellPoints& points,
            std::vector<CellEquations> cells,
            const std::vector<bool>& fixed,
            const SurfaceFitOptions& options,
            Eigen::MatrixXd& unknowns,
            FitReport& report)
{
  constexpr Eigen::Index kMostForCeres = 200;
  report.undetermined = countUndetermined(points, cells);
  const double stiffness = options.fairness * totalInformation(cells);
  // A trace of membrane energy also holds degree 1, which has no second derivatives.
  addFairness(points, {stiffness, 1e-3 * stiffness}, cells);
  const bool use_ceres =
      options.linear_solver == LinearSolver::Ceres ||
      (options.linear_solver == LinearSolver::Auto && unknowns.size() <= kMostForCeres);
  if (!use_ceres) {
    report.converged = NormalEquations(points, cells).solve(fixed, unknowns);
    if (!report.converged)
      report.message = "the points do not determine all control points";
    return report.converged;
  }
  std::vector<TriangularCell> factors;
  factors.reserve(cells.size());
  for (const CellEquations& cell : cells)
    factors.push_back(factorizeCell(cell));
  const CeresReport solved =
      solveLinearCells(points, factors, fixed, ceresLimits(options), unknowns);
  report.converged = solved.converged;
  report.message = solved.usable ? "" : solved.message;
  return solved.usable && unknowns.allFinite();
}

void
measureFit(const SplitPoints& points, const SurfaceFitOptions& options, SurfaceFit& fit)
{
  FitReport& report = fit.report;
  const Eigen::VectorXd distance = orthogonalDistances(
      fit.surface, points.fitted.positions, fit.parameters, options.threads);
  report.fitted_points = static_cast<int>(distance.size());
  report.rmse =
      std::sqrt(distance.squaredNorm() / static_cast<double>(distance.size()));
  report.max = distance.cwiseAbs().maxCoeff();
  report.foldovers = countFoldovers(fit.surface);
  if (report.foldovers > 0 && report.message.empty())
    report.message =
        "the surface folds over in " + std::to_string(report.foldovers) + " knot cells";
  if (points.held_out.positions.cols() == 0)
    return;
  Eigen::Matrix2Xd uv = points.held_out.parameters;
  const Eigen::VectorXd held =
      orthogonalDistances(fit.surface, points.held_out.positions, uv, options.threads);
  std::vector<double> sizes(held.data(), held.data() + held.size());
  for (double& size : sizes)
    size = std::abs(size);
  const auto p95 =
      sizes.begin() + static_cast<std::ptrdiff_t>(0.95 * (sizes.size() - 1));
  std::nth_element(sizes.begin(), p95, sizes.end());
  report.held_out_points = static_cast<int>(held.size());
  report.held_out_rmse =
      std::sqrt(held.squaredNorm() / static_cast<double>(held.size()));
  report.held_out_p95 = *p95;
}

Eigen::VectorXd
orthogonalDistances(const NurbsSurface& surface,
                    const Eigen::Matrix3Xd& positions,
                    Eigen::Matrix2Xd& parameters,
                    int threads,
                    double last_step)
{
  if (parameters.cols() != positions.cols())
    throw std::invalid_argument("orthogonalDistances: one (u, v) per point is needed");
  constexpr int kSteps = 10;
  Eigen::VectorXd result(positions.cols());
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
  for (Eigen::Index k = 0; k < positions.cols(); ++k) {
    const SurfaceJet1 jet = projectFrom(
        surface, positions.col(k), kSteps, 0.0, last_step, parameters.col(k));
    const Eigen::Vector3d offset = positions.col(k) - jet.position;
    result(k) = std::copysign(offset.norm(), offset.dot(jet.du.cross(jet.dv)));
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
