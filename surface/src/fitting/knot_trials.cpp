// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "knot_trials.h"

#include "cell_values.h"
#include "fairness.h"
#include "knot_search.h"
#include "normal_equations.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** Noise of a sample of unit weight: what the samples show; what was stated only keeps
 * data without any noise of its own (simulated, or coarsely quantised) from asking for
 * knots without end. So a noise stated wrongly by a factor of four changes nothing. */
double
sampleNoise(const SampleGrid& samples, double stated)
{
  constexpr double kTrust = 0.25;
  const double shown = samples.noise();
  return shown > 0.0 ? std::max(shown, kTrust * stated) : stated;
}

/** Residual of a sample of unit weight that rounding and the trace of stiffness leave
 * behind: whatever is below says nothing. */
double
roundingFloor(const SampleGrid& samples)
{
  constexpr double kRelative = 1e-9;
  const double energy =
      (samples.weights.transpose() * samples.values.cwiseAbs2()).sum() /
      static_cast<double>(samples.values.size());
  return std::max(kRelative * std::sqrt(energy), std::numeric_limits<double>::min());
}

} // namespace

KnotTrials::KnotTrials(const SampleGrid& samples,
                       double noise,
                       const KnotSearchOptions& options)
    : samples_(samples),
      options_(options),
      stated_(noise),
      floor_(roundingFloor(samples)),
      noise_(std::max(sampleNoise(samples, noise), floor_))
{
}

void
KnotTrials::evaluate(KnotModel& model) const
{
  const int controls = model.u.controls() * model.v.controls();
  if (controls > options_.max_control_points || controls > samples_.size())
    return;
  const CellPoints points(model.u.knots(), model.v.knots(), samples_.parameters);
  std::vector<CellEquations> cells = reduceCells(points, sampleRows(points), 1);
  // Just enough stiffness for control points without samples; far below the noise.
  constexpr double kStiffness = 1e-8;
  const double stiffness = kStiffness * samples_.weights.sum() / controls;
  addFairness(points, {stiffness, 1e-3 * stiffness}, cells);
  Eigen::MatrixXd coefficients(controls, samples_.values.cols());
  if (!NormalEquations(points, cells).solve({}, coefficients))
    return;
  model.residuals = samples_.weights.cwiseSqrt().asDiagonal() *
                    (samples_.values - evaluateCells(points, coefficients));
  const double values = static_cast<double>(samples_.values.size());
  const double stored = controls * static_cast<double>(samples_.values.cols()) +
                        model.u.innerKnots() + model.v.innerKnots();
  // Mean weight 1, so that RSS / n is a variance.
  const double scale = static_cast<double>(samples_.size()) / samples_.weights.sum();
  const double rounding = floor_ * floor_ * values;
  double rss = std::max(model.residuals.squaredNorm(), rounding) * scale;
  if (options_.criterion == ModelCriterion::KnownNoise)
    rss /= std::max(stated_ * stated_ * scale, std::numeric_limits<double>::min());
  model.criterion = modelCriterion(options_.criterion, values, rss, stored);
}

PointRows
KnotTrials::sampleRows(const CellPoints& points) const
{
  const Eigen::Index n = samples_.size();
  PointRows rows;
  rows.right_hand_sides = static_cast<int>(samples_.values.cols());
  rows.gram.resize(n, 1);
  rows.moments.resize(n, samples_.values.cols());
  rows.squares.resize(n, samples_.values.cols());
  for (Eigen::Index k = 0; k < n; ++k) {
    const int sample = points.order[static_cast<std::size_t>(k)];
    const double weight = samples_.weights(sample);
    rows.gram(k, 0) = weight;
    rows.moments.row(k) = weight * samples_.values.row(sample);
    rows.squares.row(k) = weight * samples_.values.row(sample).cwiseAbs2();
  }
  return rows;
}

double
modelCriterion(ModelCriterion criterion, double samples, double rss, double parameters)
{
  const double log_likelihood = samples * std::log(rss / samples);
  switch (criterion) {
  case ModelCriterion::AIC:
    return log_likelihood + 2.0 * parameters;
  case ModelCriterion::AICc:
    if (samples - parameters - 1.0 <= 0.0)
      return std::numeric_limits<double>::infinity();
    return log_likelihood + 2.0 * parameters * samples / (samples - parameters - 1.0);
  case ModelCriterion::BIC:
    return log_likelihood + parameters * std::log(samples);
  case ModelCriterion::KnownNoise:
    return rss + 2.0 * parameters;
  }
  return std::numeric_limits<double>::infinity();
}

} // namespace nurbs
} // namespace pcl
