// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "knot_moves.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pcl {
namespace nurbs {

SalientRegion
salientRegion(const SampleGrid& samples, const BinGroup& group)
{
  SalientRegion result;
  result.low = samples.low +
               samples.bin_size.cwiseProduct(Eigen::Vector2d(group.row, group.column));
  result.high = result.low + samples.bin_size.cwiseProduct(
                                 Eigen::Vector2d(group.rows, group.columns));
  result.significance = group.significance;
  return result;
}

KnotAxis
KnotMoves::refined(const KnotAxis& axis,
                   int dimension,
                   int knots,
                   bool strongest_only) const
{
  const std::size_t spans = axis.breaks.size() - 1;
  std::vector<double> energy(spans, 0.0);
  std::vector<double> moment(spans, 0.0);
  for (const BinGroup& group : salient_) {
    const SalientRegion where = salientRegion(samples_, group);
    const double centre = 0.5 * (where.low(dimension) + where.high(dimension));
    const auto span = static_cast<std::size_t>(
        std::upper_bound(axis.breaks.begin() + 1, axis.breaks.end() - 1, centre) -
        axis.breaks.begin() - 1);
    energy[span] += group.energy;
    moment[span] += group.energy * centre;
  }
  const double strongest = *std::max_element(energy.begin(), energy.end());
  KnotAxis result = axis;
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
KnotMoves::allowed(const KnotAxis& axis, int fixed_degree) const
{
  return fixed_degree > 0 ? axis.degree == fixed_degree
                          : axis.degree <= options_.max_degree;
}

std::vector<KnotModel>
KnotMoves::growth() const
{
  std::vector<KnotModel> moves;
  const auto add = [&](KnotAxis u, KnotAxis v) {
    const bool known =
        std::any_of(moves.begin(), moves.end(), [&](const KnotModel& move) {
          return move.u == u && move.v == v;
        });
    if (known || (u == model_.u && v == model_.v) || !allowed(u, options_.degree_u) ||
        !allowed(v, options_.degree_v))
      return;
    moves.emplace_back(std::move(u), std::move(v));
  };
  for (int knots : {1, 2}) { // one knot in the middle does nothing for an odd shape
    const KnotAxis all_u = refined(model_.u, 0, knots, false);
    const KnotAxis all_v = refined(model_.v, 1, knots, false);
    add(all_u, model_.v);
    add(model_.u, all_v);
    add(all_u, all_v);
  }
  if (model_.u.innerKnots() > 0)
    add(refined(model_.u, 0, 1, true), model_.v);
  if (model_.v.innerKnots() > 0)
    add(model_.u, refined(model_.v, 1, 1, true));
  for (int step : {1, 2}) { // an even or odd shape needs two degrees more at once
    add({model_.u.degree + step, model_.u.breaks}, model_.v);
    add(model_.u, {model_.v.degree + step, model_.v.breaks});
    add({model_.u.degree + step, model_.u.breaks},
        {model_.v.degree + step, model_.v.breaks});
  }
  return moves;
}

std::vector<KnotModel>
KnotMoves::shrink() const
{
  constexpr int kMostKnotsTried = 24;
  std::vector<KnotModel> moves;
  const auto without = [](KnotAxis axis, std::size_t knot) {
    axis.breaks.erase(axis.breaks.begin() + static_cast<std::ptrdiff_t>(knot));
    return axis;
  };
  if (model_.u.innerKnots() + model_.v.innerKnots() <= kMostKnotsTried) {
    for (std::size_t k = 1; k + 1 < model_.u.breaks.size(); ++k)
      moves.emplace_back(without(model_.u, k), model_.v);
    for (std::size_t k = 1; k + 1 < model_.v.breaks.size(); ++k)
      moves.emplace_back(model_.u, without(model_.v, k));
  }
  if (model_.u.degree > 1 && options_.degree_u == 0)
    moves.emplace_back(KnotAxis{model_.u.degree - 1, model_.u.breaks}, model_.v);
  if (model_.v.degree > 1 && options_.degree_v == 0)
    moves.emplace_back(model_.u, KnotAxis{model_.v.degree - 1, model_.v.breaks});
  return moves;
}

} // namespace nurbs
} // namespace pcl
