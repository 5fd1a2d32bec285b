// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief What a model must pay for its coefficients. n counts independent samples, RSS
 * is the residual sum of squares, k counts stored numbers (control values and inner
 * knots).
 */
enum class ModelCriterion {
  AIC,       /**< n ln(RSS / n) + 2 k (Akaike 1974) */
  AICc,      /**< AIC with the small-sample term 2 k (k + 1) / (n - k - 1) */
  BIC,       /**< n ln(RSS / n) + k ln n (Schwarz 1978) */
  KnownNoise /**< RSS / sigma^2 + 2 k, for a noise that is really known */
};

/** \brief Loss rho(r^2) of a residual r in units of its noise; \a scale is where it
 * leaves the square. */
enum class RobustLoss {
  Squared, /**< r^2 */
  Huber,   /**< linear beyond the scale */
  Cauchy,  /**< scale^2 ln(1 + r^2 / scale^2) */
  Tukey    /**< biweight: constant beyond the scale */
};

/** \brief Which distance is minimised. */
enum class FitDistance {
  Parametric,  /**< at the given parameters: a linear problem */
  Alternating, /**< parametric fits and projections onto the surface in turn (Hoschek)
                */
  Orthogonal   /**< to the nearest point of the surface: parameters and control points
                    together, by variable projection */
};

/** \brief Who solves a linear problem. Both give the same result up to rounding. */
enum class LinearSolver {
  Auto,    /**< Ceres for small nets, Cholesky for large ones */
  Ceres,   /**< one residual block per knot cell and coordinate */
  Cholesky /**< one band factor of the normal equations for all coordinates */
};

/** \brief Options of the search for degrees and knots (salient points by group
 * testing).
 */
struct KnotSearchOptions {
  ModelCriterion criterion = ModelCriterion::AICc;
  int max_degree = 5;             /**< highest degree tried, at most kMaxDegree */
  int degree_u = 0;               /**< fixed degree in u; 0 means it is searched */
  int degree_v = 0;               /**< the same for v */
  int max_control_points = 1024;  /**< largest net tried */
  int max_samples = 4096;         /**< points are binned to about so many samples */
  double points_per_sample = 1.0; /**< points in one patch of correlated noise: so many
                                       count as one independent sample */
  double significance = 3.0;      /**< standard deviations that make a group positive */
};

/** \brief Options of a fit with given knots. */
struct SurfaceFitOptions {
  FitDistance distance = FitDistance::Orthogonal;
  RobustLoss loss = RobustLoss::Squared;
  double loss_scale = 3.0; /**< in standard deviations of the noise */
  double fairness = 1e-9;  /**< weight of the thin-plate energy over the unit square,
                                beside the information of the points */
  int max_iterations = 20; /**< of the nonlinear solver, or of parameter correction */
  double tolerance = 1e-6; /**< relative decrease of the cost that ends iterations */
  int hold_out_every = 0;  /**< every so-manieth point is only measured, never fitted */
  LinearSolver linear_solver = LinearSolver::Auto;
  bool measure = true; /**< fill in the distances of the report; without, a fit of
                            many points takes about half the time */
  int threads = 1;
};

/** \brief A parameter region whose residual does not look like noise. */
struct SalientRegion {
  Eigen::Vector2d low;     /**< smallest (u, v) */
  Eigen::Vector2d high;    /**< largest (u, v) */
  double significance = 0; /**< residual energy over its expectation, in deviations */
};

/** \brief What a fit did and how far its result can be trusted. */
struct FitReport {
  bool converged = false;
  int iterations = 0;
  double rmse = 0.0; /**< of the fitted points, orthogonal, metres */
  double max = 0.0;  /**< largest of these distances, metres */
  int fitted_points = 0;
  double held_out_rmse = 0.0; /**< of the held-out points; 0 if there are none */
  double held_out_p95 = 0.0;  /**< 95th percentile of their distances */
  int held_out_points = 0;
  int undetermined = 0;   /**< control points that no fitted point acts on: placed by
                               fairness alone */
  int foldovers = 0;      /**< knot cells in which the surface turns over */
  double criterion = 0.0; /**< value of the model criterion, if knots were searched */
  std::vector<SalientRegion> salient; /**< regions still unlike noise at the end */
  std::string message; /**< one line on what went wrong, empty if nothing */
};

} // namespace nurbs
} // namespace pcl
