// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "knot_search.h"

#include "group_testing.h"
#include "knot_moves.h"
#include "knot_trials.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Goes from model to model while the criterion falls. */
class KnotSearch {
public:
  KnotSearch(const SampleGrid& samples,
             double noise,
             const KnotSearchOptions& options,
             const SurfaceKnots* start)
      : samples_(samples), options_(options), trials_(samples, noise, options)
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
    trials_.evaluate(best_);
  }

  KnotSearchResult
  run()
  {
    if (best_.residuals.size() != 0) // else there are too few samples for any model
      search();
    KnotSearchResult result;
    result.knots_u = best_.u.knots();
    result.knots_v = best_.v.knots();
    result.criterion = best_.criterion;
    for (const BinGroup& group : salient_)
      result.salient.push_back(salientRegion(samples_, group));
    return result;
  }

private:
  void
  search()
  {
    findSalient();
    while (!salient_.empty() && improve(moves().growth()))
      findSalient();
    bool shrunk = false;
    while (improve(moves().shrink()))
      shrunk = true;
    if (shrunk)
      findSalient();
  }

  KnotMoves
  moves() const
  {
    return {samples_, options_, best_, salient_};
  }

  void
  findSalient()
  {
    Eigen::MatrixXd scores = Eigen::MatrixXd::Constant(
        samples_.rows, samples_.columns, std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index k = 0; k < samples_.size(); ++k) {
      const int bin = samples_.bin[static_cast<std::size_t>(k)];
      // Of vector values the component that deviates most speaks for the sample.
      Eigen::Index largest;
      best_.residuals.row(k).cwiseAbs().maxCoeff(&largest);
      scores(bin / samples_.columns, bin % samples_.columns) =
          best_.residuals(k, largest) / trials_.noise();
    }
    salient_ = findSalientGroups(scores, options_.significance);
  }

  /** Take the move with the lowest criterion if it lowers the present one. */
  bool
  improve(std::vector<KnotModel> moves)
  {
    for (KnotModel& move : moves)
      trials_.evaluate(move);
    const auto best = std::min_element(
        moves.begin(), moves.end(), [](const KnotModel& a, const KnotModel& b) {
          return a.criterion < b.criterion;
        });
    if (best == moves.end() || !(best->criterion < best_.criterion))
      return false;
    best_ = std::move(*best);
    return true;
  }

  const SampleGrid& samples_;
  const KnotSearchOptions& options_;
  KnotTrials trials_;
  KnotModel best_;
  std::vector<BinGroup> salient_;
};

} // namespace

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
