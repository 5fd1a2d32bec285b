// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "ring_detection.h"

#include "ring_seam.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl {
namespace nurbs {
namespace {

constexpr float kTurn = static_cast<float>(2.0 * M_PI);
constexpr std::size_t kLeastRings = 8;
constexpr std::size_t kMostRings = 256;

double
median(std::vector<float>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** Signed azimuth steps from point to point. */
std::vector<float>
azimuthSteps(const ChartList& charts)
{
  std::vector<float> steps;
  float before = std::numeric_limits<float>::quiet_NaN();
  for (const Eigen::Vector3f& chart : charts) {
    const float step = std::remainder(chart.x() - before, kTurn);
    if (std::isfinite(step))
      steps.push_back(step);
    if (std::isfinite(chart.x()))
      before = chart.x();
  }
  return steps;
}

/** Fill in angles and sort the rings by them, from the top. */
void
sortRings(const ChartList& charts, std::size_t count, Rings& rings)
{
  std::vector<std::vector<float>> angles(count);
  for (std::size_t i = 0; i < charts.size(); ++i)
    if (rings.ring[i] >= 0)
      angles[static_cast<std::size_t>(rings.ring[i])].push_back(charts[i].y());
  std::vector<double> typical(count);
  for (std::size_t r = 0; r < count; ++r)
    typical[r] = angles[r].empty() ? 0.0 : median(angles[r]);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return typical[a] < typical[b];
  });
  std::vector<std::int32_t> rank(count);
  for (std::size_t r = 0; r < count; ++r) {
    rank[order[r]] = static_cast<std::int32_t>(r);
    rings.depression.push_back(typical[order[r]]);
  }
  for (std::int32_t& ring : rings.ring)
    if (ring >= 0)
      ring = rank[static_cast<std::size_t>(ring)];
}

/** Whether most rings lie in the order of their angles; stored rings do. */
bool
isSteady(const Rings& rings)
{
  std::size_t rising = 0;
  std::size_t changes = 0;
  std::int32_t before = -1;
  for (const std::int32_t ring : rings.ring) {
    if (ring < 0 || ring == before)
      continue;
    if (before >= 0) {
      ++changes;
      rising += ring > before ? 1 : 0;
    }
    before = ring;
  }
  return std::max(rising, changes - rising) * 10 >= changes * 9;
}

} // namespace

Rings
ringsFromOrder(const ChartList& charts)
{
  std::vector<float> steps = azimuthSteps(charts);
  if (steps.size() < 32 * kLeastRings)
    return {};
  const float sense = median(steps) < 0.0 ? -1.0F : 1.0F;
  const auto forward = std::count_if(
      steps.begin(), steps.end(), [sense](float step) { return sense * step > 0.0F; });
  if (static_cast<std::size_t>(forward) * 10 < steps.size() * 7)
    return {};
  const Sweep sweep = sweepOf(charts, sense);
  if (sweep.turns > static_cast<std::int32_t>(kMostRings) + 1)
    return {};
  Rings rings;
  rings.ring.assign(charts.size(), -1);
  const std::vector<std::size_t> starts = ringStarts(sweep);
  if (starts.size() < kLeastRings || starts.size() > kMostRings)
    return {};
  for (std::size_t ring = 0; ring < starts.size(); ++ring) {
    const std::size_t end =
        ring + 1 < starts.size() ? starts[ring + 1] : sweep.point.size();
    for (std::size_t i = starts[ring]; i < end; ++i)
      rings.ring[sweep.point[i]] = static_cast<std::int32_t>(ring);
  }
  sortRings(charts, starts.size(), rings);
  if (!isSteady(rings))
    return {};
  for (float& step : steps)
    step = std::abs(step);
  rings.azimuth_step = median(steps);
  return rings;
}

Rings
ringsFromAngles(const ChartList& charts)
{
  constexpr std::size_t kBins = 4096;
  float top = std::numeric_limits<float>::infinity();
  float bottom = -top;
  std::size_t points = 0;
  for (const Eigen::Vector3f& chart : charts)
    if (std::isfinite(chart.y())) {
      top = std::min(top, chart.y());
      bottom = std::max(bottom, chart.y());
      ++points;
    }
  if (points < 32 * kLeastRings || !(top < bottom))
    return {};
  const float scale = (static_cast<float>(kBins) - 1.0F) / (bottom - top);
  const auto bin = [&](float v) { return static_cast<std::size_t>((v - top) * scale); };
  std::vector<std::size_t> histogram(kBins, 0);
  for (const Eigen::Vector3f& chart : charts)
    if (std::isfinite(chart.y()))
      ++histogram[bin(chart.y())];
  // A ring is a run of bins that are fuller than a share of the average.
  std::vector<std::int32_t> ring_of_bin(kBins, -1);
  std::int32_t count = 0;
  std::size_t occupied = 0;
  for (std::size_t b = 0; b < kBins; ++b) {
    if (histogram[b] * kBins * 4 < points)
      continue;
    ++occupied;
    count += b == 0 || ring_of_bin[b - 1] < 0 ? 1 : 0;
    ring_of_bin[b] = count - 1;
  }
  const auto rings_found = static_cast<std::size_t>(count);
  if (rings_found < kLeastRings || rings_found > kMostRings || occupied * 2 > kBins)
    return {};
  Rings rings;
  rings.ring.assign(charts.size(), -1);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < charts.size(); ++i)
    if (std::isfinite(charts[i].y())) {
      rings.ring[i] = ring_of_bin[bin(charts[i].y())];
      inside += rings.ring[i] >= 0 ? 1 : 0;
    }
  if (inside * 100 < points * 97)
    return {};
  sortRings(charts, rings_found, rings);
  rings.azimuth_step = static_cast<double>(kTurn) * count / static_cast<double>(points);
  return rings;
}

} // namespace nurbs
} // namespace pcl
