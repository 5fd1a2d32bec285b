// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "ring_seam.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr auto kPi = static_cast<float>(M_PI);
constexpr float kTurn = 2.0F * kPi;
constexpr float kTremble = kPi / 18.0F;   // no laser turns back so far
constexpr float kSeamWidth = kPi / 90.0F; // beams pass the seam this early or late
constexpr float kMostStep = kPi / 180.0F; // between neighbouring rings
constexpr std::size_t kBins = 360;        // of azimuth

/** Beams start up to a quarter of a metre beside the sensor's centre, so that the
 * depression changes with the inverse of the depth. Neighbours whose inverses differ
 * by more (1/m) say little: a tenth of a degree could be that. */
constexpr float kSameDepth = 0.007F;

/** Change of depression from the point before that only another beam explains. */
float
beamStep(const Sweep& sweep, std::size_t i)
{
  if (!(std::abs(1.0F / sweep.depth[i] - 1.0F / sweep.depth[i - 1]) < kSameDepth))
    return 0.0F;
  const float step = sweep.depression[i] - sweep.depression[i - 1];
  return std::clamp(step, -kMostStep, kMostStep);
}

/** Azimuth step, forward but for trembling: what steps back further went the long way
 * around, over directions nothing came back from. */
float
forwardStep(float before, float here)
{
  const float step = std::remainder(here - before, kTurn);
  return step < -kTremble ? step + kTurn : step;
}

std::size_t
binOf(float azimuth)
{
  const float turns = azimuth / kTurn + 0.5F;
  const float since_behind = turns - std::floor(turns);
  return static_cast<std::size_t>(since_behind * static_cast<float>(kBins)) % kBins;
}

/** Where rings begin, and how the depression steps there, all rings together. */
struct Seam {
  float azimuth = 0.0F;
  float rise = 0.0F;
};

Seam
findSeam(const Sweep& sweep)
{
  std::vector<float> risen(kBins, 0.0F);
  for (std::size_t i = 1; i < sweep.point.size(); ++i) {
    const float step = forwardStep(sweep.azimuth[i - 1], sweep.azimuth[i]);
    risen[binOf(sweep.azimuth[i - 1] + 0.5F * step)] += beamStep(sweep, i);
  }
  Seam seam;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    // Steps on both sides of the border before the bin count.
    const float sum = risen[(bin + kBins - 1) % kBins] + risen[bin];
    if (std::abs(sum) <= std::abs(seam.rise))
      continue;
    seam.azimuth = (static_cast<float>(bin) / static_cast<float>(kBins) - 0.5F) * kTurn;
    seam.rise = sum;
  }
  return seam;
}

} // namespace

Sweep
sweepOf(const std::vector<Eigen::Vector3f>& charts, float sense)
{
  Sweep sweep;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    if (!std::isfinite(charts[i].x()))
      continue;
    const float azimuth = std::remainder(sense * charts[i].x(), kTurn);
    std::int32_t turn = 0;
    if (!sweep.point.empty()) {
      const float before = sweep.azimuth.back();
      const float step = forwardStep(before, azimuth);
      turn = sweep.turn.back() +
             static_cast<std::int32_t>(std::lround((before + step - azimuth) / kTurn));
    }
    sweep.point.push_back(i);
    sweep.azimuth.push_back(azimuth);
    sweep.depression.push_back(charts[i].y());
    sweep.depth.push_back(charts[i].z());
    sweep.turn.push_back(turn);
  }
  if (sweep.turn.empty())
    return sweep;
  const auto [least, most] = std::minmax_element(sweep.turn.begin(), sweep.turn.end());
  const std::int32_t first = *least;
  sweep.turns = *most - first + 1;
  for (std::int32_t& turn : sweep.turn)
    turn -= first;
  return sweep;
}

std::vector<std::size_t>
ringStarts(const Sweep& sweep)
{
  const std::size_t size = sweep.point.size();
  const Seam seam = findSeam(sweep);
  const auto ring_of = [&](std::size_t i) {
    return sweep.turn[i] - (sweep.azimuth[i] < seam.azimuth ? 1 : 0);
  };
  std::vector<std::size_t> passes = {0};
  for (std::size_t i = 1; i < size; ++i)
    if (ring_of(i) > ring_of(passes.back()))
      passes.push_back(i);
  if (seam.rise == 0.0F)
    return passes;
  // A step worth moving a start for is half of what rings are apart on average.
  const float apart = seam.rise / static_cast<float>(passes.size());
  const auto rise = [&](std::size_t i) { return beamStep(sweep, i) / apart; };
  const auto at_seam = [&](std::size_t i) {
    return std::abs(std::remainder(sweep.azimuth[i] - seam.azimuth, kTurn)) <
           kSeamWidth;
  };
  std::vector<std::size_t> starts = {0};
  for (std::size_t p = 1; p < passes.size(); ++p) {
    std::size_t first = passes[p];
    while (first > starts.back() && at_seam(first - 1))
      --first;
    std::size_t last = passes[p];
    while (last < size && at_seam(last))
      ++last;
    // The first ring may begin, and the last one end, on the wrong side of the seam.
    if (first == starts.back() || last == size)
      continue;
    std::size_t start = passes[p];
    for (std::size_t i = first; i <= last; ++i)
      if (rise(i) > std::max(0.5F, rise(start)))
        start = i;
    starts.push_back(start);
  }
  return starts;
}

} // namespace nurbs
} // namespace pcl
