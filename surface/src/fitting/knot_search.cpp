// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "knot_search.h"

#include "cell_equations.h"
#include "fairness.h"
#include "group_testing.h"
#include "normal_equations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Degree and breaks of one direction: what a move changes. */
struct Axis {
  int degree = 1;
  std::vector<double> breaks;

  KnotVector
  knots() const
  {
    return KnotVector::clamped(degree, breaks);
  }

  int
  controls() const
  {
    return degree + static_cast<int>(breaks.size()) - 1;
  }

  int
  innerKnots() const
  {
    return static_cast<int>(breaks.size()) - 2;
  }

  bool
  operator==(const Axis& other) const
  {
    return degree == other.degree && breaks == other.breaks;
  }
};

struct Model {
  Model() = default;

  Model(Axis axis_u, Axis axis_v) : u(std::move(axis_u)), v(std::move(axis_v)) {}

  Axis u;
  Axis v;
  double criterion = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd coefficients;
};

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

/** Tries models on the samples. */
class KnotSearch {
public:
  KnotSearch(const SampleGrid& samples,
             double noise,
             const KnotSearchOptions& options,
             const SurfaceKnots* start)
      : samples_(samples),
        options_(options),
        stated_(noise),
        floor_(roundingFloor(samples)),
        noise_(std::max(sampleNoise(samples, noise), floor_))
  {
    best_.u.breaks = {samples.low.x(),
                      samples.low.x() + samples.rows * samples.bin_size.x()};
    best_.v.breaks = {samples.low.y(),
                      samples.low.y() + samples.columns * samples.bin_size.y()};
    best_.u.degree = std::max(1, options.degree_u);
    best_.v.degree = std::max(1, options.degree_v);
    if (start != nullptr) {
      best_.u = {start->first.degree(), start->first.breaks()};
      best_.v = {start->second.degree(), start->second.breaks()};
    }
    evaluate(best_);
  }

  KnotSearchResult
  run()
  {
    if (best_.coefficients.size() != 0) // else there are too few samples for any model
      search();
    KnotSearchResult result;
    result.knots_u = best_.u.knots();
    result.knots_v = best_.v.knots();
    result.criterion = best_.criterion;
    for (const BinGroup& group : salient_)
      result.salient.push_back(region(group));
    return result;
  }

private:
  void
  search()
  {
    findSalient();
    while (!salient_.empty() && improve(growthMoves()))
      findSalient();
    while (improve(shrinkMoves())) {
    }
    findSalient();
  }

  /** Fit a model to the samples and set its criterion; infinite if it cannot be fitted.
   */
  void
  evaluate(Model& model) const
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
    const NormalEquations equations(points, cells);
    model.coefficients.setZero(controls, samples_.values.cols());
    if (!equations.solve({}, model.coefficients))
      return;
    const double values = static_cast<double>(samples_.values.size());
    const double stored = controls * static_cast<double>(samples_.values.cols()) +
                          model.u.innerKnots() + model.v.innerKnots();
    // Mean weight 1, so that RSS / n is a variance.
    const double scale = static_cast<double>(samples_.size()) / samples_.weights.sum();
    const double rounding = floor_ * floor_ * values;
    double rss = std::max(residuals(model).squaredNorm(), rounding) * scale;
    if (options_.criterion == ModelCriterion::KnownNoise)
      rss /= std::max(stated_ * stated_ * scale, std::numeric_limits<double>::min());
    model.criterion = modelCriterion(options_.criterion, values, rss, stored);
  }

  PointRows
  sampleRows(const CellPoints& points) const
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

  /** Residuals times the roots of their weights. */
  Eigen::MatrixXd
  residuals(const Model& model) const
  {
    const KnotVector u = model.u.knots();
    const KnotVector v = model.v.knots();
    Eigen::MatrixXd result = samples_.values;
    BasisValues basis_u;
    BasisValues basis_v;
    for (Eigen::Index k = 0; k < samples_.size(); ++k) {
      const int span_u = u.findSpan(samples_.parameters(0, k));
      const int span_v = v.findSpan(samples_.parameters(1, k));
      u.evaluateBasis(span_u, samples_.parameters(0, k), basis_u);
      v.evaluateBasis(span_v, samples_.parameters(1, k), basis_v);
      for (int i = 0; i <= u.degree(); ++i)
        for (int j = 0; j <= v.degree(); ++j)
          result.row(k) -=
              basis_u[static_cast<std::size_t>(i)] *
              basis_v[static_cast<std::size_t>(j)] *
              model.coefficients.row((span_u - u.degree() + i) * v.numControlPoints() +
                                     span_v - v.degree() + j);
      result.row(k) *= std::sqrt(samples_.weights(k));
    }
    return result;
  }

  void
  findSalient()
  {
    const Eigen::MatrixXd residual = residuals(best_);
    Eigen::MatrixXd scores = Eigen::MatrixXd::Constant(
        samples_.rows, samples_.columns, std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index k = 0; k < samples_.size(); ++k) {
      const int bin = samples_.bin[static_cast<std::size_t>(k)];
      // Of vector values the component that deviates most speaks for the sample.
      Eigen::Index largest;
      residual.row(k).cwiseAbs().maxCoeff(&largest);
      scores(bin / samples_.columns, bin % samples_.columns) =
          residual(k, largest) / noise_;
    }
    salient_ = findSalientGroups(scores, options_.significance);
  }

  SalientRegion
  region(const BinGroup& group) const
  {
    SalientRegion result;
    result.low = samples_.low + samples_.bin_size.cwiseProduct(
                                    Eigen::Vector2d(group.row, group.column));
    result.high = result.low + samples_.bin_size.cwiseProduct(
                                   Eigen::Vector2d(group.rows, group.columns));
    result.significance = group.significance;
    return result;
  }

  /** Add a knot in every span with salient energy, at the centre of that energy, or two
   * that split it in three; with \a strongest_only in the span that has most of it. */
  Axis
  refined(const Axis& axis, int dimension, int knots, bool strongest_only) const
  {
    const std::size_t spans = axis.breaks.size() - 1;
    std::vector<double> energy(spans, 0.0);
    std::vector<double> moment(spans, 0.0);
    for (const BinGroup& group : salient_) {
      const SalientRegion where = region(group);
      const double centre = 0.5 * (where.low(dimension) + where.high(dimension));
      const auto span = static_cast<std::size_t>(
          std::upper_bound(axis.breaks.begin() + 1, axis.breaks.end() - 1, centre) -
          axis.breaks.begin() - 1);
      energy[span] += group.energy;
      moment[span] += group.energy * centre;
    }
    const double strongest = *std::max_element(energy.begin(), energy.end());
    Axis result = axis;
    for (std::size_t span = 0; span < spans; ++span) {
      const double begin = axis.breaks[span];
      const double end = axis.breaks[span + 1];
      const double margin = 0.25 * (end - begin);
      const bool resolvable = margin >= samples_.bin_size(dimension);
      if (energy[span] == 0.0 || !resolvable ||
          (strongest_only && energy[span] < strongest))
        continue;
      if (knots == 1)
        result.breaks.push_back(
            std::clamp(moment[span] / energy[span], begin + margin, end - margin));
      else
        for (double third : {1.0 / 3.0, 2.0 / 3.0})
          result.breaks.push_back(begin + third * (end - begin));
    }
    std::sort(result.breaks.begin(), result.breaks.end());
    return result;
  }

  bool
  allowed(const Axis& axis, int fixed_degree) const
  {
    return fixed_degree > 0 ? axis.degree == fixed_degree
                            : axis.degree <= options_.max_degree;
  }

  std::vector<Model>
  growthMoves() const
  {
    std::vector<Model> moves;
    const auto add = [&](Axis u, Axis v) {
      const bool known =
          std::any_of(moves.begin(), moves.end(), [&](const Model& move) {
            return move.u == u && move.v == v;
          });
      if (known || (u == best_.u && v == best_.v) || !allowed(u, options_.degree_u) ||
          !allowed(v, options_.degree_v))
        return;
      moves.emplace_back(std::move(u), std::move(v));
    };
    for (int knots : {1, 2}) { // one knot in the middle does nothing for an odd shape
      const Axis all_u = refined(best_.u, 0, knots, false);
      const Axis all_v = refined(best_.v, 1, knots, false);
      add(all_u, best_.v);
      add(best_.u, all_v);
      add(all_u, all_v);
    }
    if (best_.u.innerKnots() > 0)
      add(refined(best_.u, 0, 1, true), best_.v);
    if (best_.v.innerKnots() > 0)
      add(best_.u, refined(best_.v, 1, 1, true));
    for (int step : {1, 2}) { // an even or odd shape needs two degrees more at once
      add({best_.u.degree + step, best_.u.breaks}, best_.v);
      add(best_.u, {best_.v.degree + step, best_.v.breaks});
      add({best_.u.degree + step, best_.u.breaks},
          {best_.v.degree + step, best_.v.breaks});
    }
    return moves;
  }

  std::vector<Model>
  shrinkMoves() const
  {
    constexpr int kMostKnotsTried = 24;
    std::vector<Model> moves;
    const auto without = [](Axis axis, std::size_t knot) {
      axis.breaks.erase(axis.breaks.begin() + static_cast<std::ptrdiff_t>(knot));
      return axis;
    };
    if (best_.u.innerKnots() + best_.v.innerKnots() <= kMostKnotsTried) {
      for (std::size_t k = 1; k + 1 < best_.u.breaks.size(); ++k)
        moves.emplace_back(without(best_.u, k), best_.v);
      for (std::size_t k = 1; k + 1 < best_.v.breaks.size(); ++k)
        moves.emplace_back(best_.u, without(best_.v, k));
    }
    if (best_.u.degree > 1 && options_.degree_u == 0)
      moves.emplace_back(Axis{best_.u.degree - 1, best_.u.breaks}, best_.v);
    if (best_.v.degree > 1 && options_.degree_v == 0)
      moves.emplace_back(best_.u, Axis{best_.v.degree - 1, best_.v.breaks});
    return moves;
  }

  /** Take the move with the lowest criterion if it lowers the present one. */
  bool
  improve(std::vector<Model> moves)
  {
    for (Model& move : moves)
      evaluate(move);
    const auto best = std::min_element(
        moves.begin(), moves.end(), [](const Model& a, const Model& b) {
          return a.criterion < b.criterion;
        });
    if (best == moves.end() || !(best->criterion < best_.criterion))
      return false;
    best_ = std::move(*best);
    return true;
  }

  const SampleGrid& samples_;
  const KnotSearchOptions& options_;
  double stated_;
  double floor_;
  double noise_;
  Model best_;
  std::vector<BinGroup> salient_;
};

} // namespace

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

KnotSearchResult
searchKnots(const SampleGrid& samples,
            double noise,
            const KnotSearchOptions& options,
            const SurfaceKnots* start)
{
  return KnotSearch(samples, noise, options, start).run();
}

SurfaceKnots
searchBinned(const Eigen::Matrix2Xd& parameters,
             const Eigen::MatrixXd& values,
             const Eigen::VectorXd& sigma,
             bool sigma_is_known,
             const KnotSearchOptions& options,
             const SurfaceKnots* start,
             FitReport& report)
{
  if (options.criterion == ModelCriterion::KnownNoise && !sigma_is_known)
    throw std::invalid_argument(
        "knot search: known noise needs the sigma of the points");
  constexpr double kFewestSamples = 16.0;
  const ParameterBox box = ParameterBox::around(parameters);
  const double count = static_cast<double>(values.rows());
  const double target = std::clamp(count / options.points_per_sample,
                                   std::min(count, kFewestSamples),
                                   static_cast<double>(options.max_samples));
  const SampleGrid samples(box.low,
                           box.high,
                           parameters,
                           values,
                           sigma.array().square().inverse(),
                           static_cast<int>(target));
  const double stated = sigma_is_known ? 1.0 : 0.0; // weights are 1 / sigma^2
  KnotSearchResult result = searchKnots(samples, stated, options, start);
  report.criterion = result.criterion;
  report.salient = std::move(result.salient);
  return {std::move(result.knots_u), std::move(result.knots_v)};
}

} // namespace nurbs
} // namespace pcl
