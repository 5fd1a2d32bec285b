// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "border_constraint.h"
#include "fit_common.h"
#include "knot_search.h"
#include "orthogonal_problem.h"
#include "robust_loss.h"

#include <pcl/surface/nurbs/surface_fitter.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** A fit with given knots and NURBS weights, in homogeneous coordinates: with fixed
 * weights w_i the condition S(u, v) = p reads sum B_i (w_i P_i) = W(u, v) p, which is
 * linear. */
class ParametricFit {
public:
  ParametricFit(const KnotVector& knots_u,
                const KnotVector& knots_v,
                const SplitPoints& points,
                const SurfaceFitOptions& options,
                const std::vector<BorderConstraint>& constraints,
                const Eigen::VectorXd& weights)
      : knots_u_(knots_u),
        knots_v_(knots_v),
        points_(points),
        options_(options),
        constraints_(constraints)
  {
    const Eigen::Index n = static_cast<Eigen::Index>(knots_u.numControlPoints()) *
                           knots_v.numControlPoints();
    if (weights.size() != 0 && weights.size() != n)
      throw std::invalid_argument(
          "parametric fit: one weight per control point is needed");
    fixed_.assign(static_cast<std::size_t>(n), false);
    unknowns_ = Eigen::MatrixXd::Zero(n, 4);
    unknowns_.col(3) = weights.size() != 0 ? weights : Eigen::VectorXd::Ones(n);
    fit_.parameters = points.fitted.parameters;
  }

  SurfaceFit
  run()
  {
    solve();
    if (!constraints_.empty()) {
      for (const BorderConstraint& constraint : constraints_)
        applyBorderConstraint(constraint, knots_u_, knots_v_, unknowns_, fixed_);
      solve();
    }
    if (options_.distance == FitDistance::Orthogonal)
      minimizeOrthogonal();
    else if (options_.distance == FitDistance::Alternating ||
             options_.loss != RobustLoss::Squared)
      alternate();
    fit_.surface = surface();
    if (options_.distance == FitDistance::Orthogonal)
      fit_.surface = extendedDomain(fit_.surface, fit_.parameters);
    measureFit(points_, options_, fit_);
    return std::move(fit_);
  }

private:
  NurbsSurface
  surface() const
  {
    return {knots_u_, knots_v_, NurbsSurface::HomogeneousPoints(unknowns_.transpose())};
  }

  /** Solve for the control points at the present parameters and robust weights. */
  void
  solve()
  {
    const CellPoints cells(knots_u_, knots_v_, fit_.parameters);
    Eigen::MatrixXd positions = unknowns_.leftCols(3);
    if (!solveLinear(cells,
                     reduceCells(cells, rows(cells), options_.threads),
                     fixed_,
                     options_,
                     positions,
                     fit_.report))
      throw std::domain_error("parametric fit: " + fit_.report.message);
    unknowns_.leftCols(3) = positions;
    ++fit_.report.iterations;
  }

  PointRows
  rows(const CellPoints& cells) const
  {
    const Eigen::Index n = fit_.parameters.cols();
    PointRows result;
    result.right_hand_sides = 3;
    result.gram.resize(n, 1);
    result.moments.resize(n, 3);
    result.squares.resize(n, 3);
    const NurbsSurface weights(
        knots_u_, knots_v_, NurbsSurface::HomogeneousPoints(weightField()));
    const bool rational = (unknowns_.col(3).array() != unknowns_(0, 3)).any();
    for (Eigen::Index k = 0; k < n; ++k) {
      const int point = cells.order[static_cast<std::size_t>(k)];
      const Eigen::Vector2d uv = fit_.parameters.col(point);
      const double weight =
          rational ? weights.evaluate(uv.x(), uv.y()).x() : unknowns_(0, 3);
      const double sigma = weight * points_.fitted.sigma(point);
      const double information =
          (robust_.size() != 0 ? robust_(point) : 1.0) / (sigma * sigma);
      const Eigen::RowVector3d target =
          weight * points_.fitted.positions.col(point).transpose();
      result.gram(k, 0) = information;
      result.moments.row(k) = information * target;
      result.squares.row(k) = information * target.cwiseAbs2();
    }
    return result;
  }

  /** The weight function as the x coordinate of a polynomial surface. */
  Eigen::Matrix4Xd
  weightField() const
  {
    Eigen::Matrix4Xd field = Eigen::Matrix4Xd::Zero(4, unknowns_.rows());
    field.row(0) = unknowns_.col(3).transpose();
    field.row(3).setOnes();
    return field;
  }

  /** Projections onto the surface and linear fits in turn, until the cost is steady. */
  void
  alternate()
  {
    double previous = std::numeric_limits<double>::infinity();
    for (int round = 0; round < options_.max_iterations; ++round) {
      const double cost = correct();
      if (std::abs(previous - cost) <= options_.tolerance * cost) {
        fit_.report.converged = true;
        return;
      }
      previous = cost;
      solve();
    }
    fit_.report.converged = false;
    fit_.report.message = "parameter correction has not converged";
  }

  /** New parameters (if they may change), robust weights, and the cost. */
  double
  correct()
  {
    Eigen::Matrix2Xd parameters = fit_.parameters;
    const NurbsSurface present = surface();
    Eigen::VectorXd distance;
    if (options_.distance == FitDistance::Alternating) {
      distance = orthogonalDistances(
          present, points_.fitted.positions, parameters, options_.threads);
      fit_.parameters = parameters;
    }
    else {
      distance.resize(parameters.cols());
      for (Eigen::Index k = 0; k < parameters.cols(); ++k)
        distance(k) = (present.evaluate(parameters(0, k), parameters(1, k)) -
                       points_.fitted.positions.col(k))
                          .norm();
    }
    robust_.resize(distance.size());
    double cost = 0.0;
    for (Eigen::Index k = 0; k < distance.size(); ++k) {
      const double s = distance(k) / points_.fitted.sigma(k);
      const LossValue loss = evaluateLoss(options_.loss, options_.loss_scale, s * s);
      robust_(k) = loss.slope;
      cost += loss.rho;
    }
    return cost;
  }

  void
  minimizeOrthogonal()
  {
    const NurbsSurface start = surface();
    const HomogeneousUnknowns unknowns(start, false);
    OrthogonalProblem problem(unknowns,
                              start,
                              points_.fitted.positions,
                              fit_.parameters,
                              points_.fitted.sigma,
                              options_);
    const CellPoints cells(knots_u_, knots_v_, fit_.parameters);
    Eigen::MatrixXd values = unknowns_.leftCols(3).transpose();
    const CeresReport solved =
        solveNonlinearCells(cells, problem, fixed_, ceresLimits(options_), values);
    fit_.report.converged = solved.converged;
    fit_.report.iterations += solved.iterations;
    fit_.report.message = solved.usable ? "" : solved.message;
    fit_.parameters = problem.parameters();
    unknowns_.leftCols(3) = values.transpose();
  }

  const KnotVector& knots_u_;
  const KnotVector& knots_v_;
  const SplitPoints& points_;
  const SurfaceFitOptions& options_;
  const std::vector<BorderConstraint>& constraints_;
  std::vector<bool> fixed_;
  Eigen::MatrixXd unknowns_; // control points x (w x, w y, w z, w)
  Eigen::VectorXd robust_;   // weight of each point; empty for 1
  SurfaceFit fit_;
};

} // namespace

SurfaceFit
fitParametric(const KnotVector& knots_u,
              const KnotVector& knots_v,
              const FitPoints& points,
              const SurfaceFitOptions& options,
              const std::vector<BorderConstraint>& constraints,
              const Eigen::VectorXd& weights)
{
  const SplitPoints split(points, options);
  if (points.parameters.cols() == 0)
    throw std::invalid_argument("parametric fit: points need parameters");
  return ParametricFit(knots_u, knots_v, split, options, constraints, weights).run();
}

SurfaceKnots
chooseParametricKnots(const FitPoints& points,
                      const KnotSearchOptions& options,
                      FitReport& report)
{
  const SplitPoints split(points, SurfaceFitOptions());
  if (points.parameters.cols() == 0)
    throw std::invalid_argument("parametric fit: points need parameters");
  return searchBinned(split.fitted.parameters,
                      split.fitted.positions.transpose(),
                      split.fitted.sigma,
                      points.sigma.size() != 0,
                      options,
                      nullptr,
                      report);
}

} // namespace nurbs
} // namespace pcl
