// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "loop_reweighting.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kMuFactor = 1.4; // as the paper has it

/** Equation (14) of Yang et al. */
double
truncatedWeight(double residual, double limit, double mu)
{
  if (residual <= mu / (mu + 1.0) * limit)
    return 1.0;
  if (residual >= (mu + 1.0) / mu * limit)
    return 0.0;
  return std::sqrt(limit / residual * mu * (mu + 1.0)) - mu;
}

/** Equation (12) of Yang et al. */
double
gemanMcClureWeight(double residual, double limit, double mu)
{
  const double share = mu * limit / (residual + mu * limit);
  return share * share;
}

/** Equation (15) of Agarwal et al. */
double
switchWeight(double residual, double limit)
{
  const double scale = std::min(1.0, 2.0 * limit / (limit + residual));
  return scale * scale;
}

class Reweighting {
public:
  explicit Reweighting(JudgedGraph& judged) : judged_(judged) {}

  /** The largest residual in units of the limit. */
  double
  worst() const
  {
    double result = 0.0;
    for (const JudgedLoop& loop : judged_.loops)
      if (loop.verdict.accepted)
        result = std::max(result, judged_.residualOf(loop) / loop.limit);
    return result;
  }

  /** \return the largest change of a weight */
  template <typename WeightOf>
  double
  reweight(const WeightOf& weightOf)
  {
    double change = 0.0;
    binary_ = true;
    for (JudgedLoop& loop : judged_.loops) {
      if (!loop.verdict.accepted)
        continue;
      const double before = judged_.graph.factor(loop.factor.id).weight;
      const double weight = weightOf(judged_.residualOf(loop), loop.limit);
      judged_.graph.setWeight(loop.factor.id, weight);
      change = std::max(change, std::abs(weight - before));
      constexpr double kNearly = 1e-6;
      binary_ = binary_ && (weight < kNearly || weight > 1.0 - kNearly);
    }
    return change;
  }

  bool
  binary() const
  {
    return binary_;
  }

  void
  decide()
  {
    for (JudgedLoop& loop : judged_.loops) {
      if (!loop.verdict.accepted)
        continue;
      const double residual = judged_.residualOf(loop);
      judged_.judge(
          loop, LoopCheck::Weight, residual, loop.limit, residual <= loop.limit);
    }
  }

private:
  JudgedGraph& judged_;
  bool binary_ = false;
};

} // namespace

void
rejectByGraduatedNonConvexity(JudgedGraph& judged, const RobustOptions& options)
{
  const bool truncated = options.loss == RobustLoss::TruncatedLeastSquares;
  Reweighting weights(judged);
  judged.solve();
  const double worst = weights.worst();
  // Remark 5: the surrogate is convex at the largest residual.
  double mu = truncated ? 1.0 / (2.0 * worst - 1.0) : 2.0 * worst;
  const bool all_fit = truncated ? mu <= 0.0 : mu <= 1.0;
  for (int k = 0; !all_fit && k < options.max_reweightings; ++k) {
    const double change = weights.reweight([&](double residual, double limit) {
      return truncated ? truncatedWeight(residual, limit, mu)
                       : gemanMcClureWeight(residual, limit, mu);
    });
    judged.solve();
    constexpr double kStays = 1e-3;
    if (truncated ? weights.binary() : mu <= 1.0 && change < kStays)
      break;
    mu = truncated ? mu * kMuFactor : std::max(1.0, mu / kMuFactor);
  }
  weights.decide();
}

void
rejectBySwitches(JudgedGraph& judged, const RobustOptions& options)
{
  Reweighting weights(judged);
  for (int k = 0; k < options.max_reweightings; ++k) {
    constexpr double kStays = 1e-3;
    if (weights.reweight(switchWeight) < kStays)
      break;
    judged.solve();
  }
  weights.decide();
}

} // namespace nurbs
} // namespace pcl
