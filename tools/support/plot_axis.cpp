// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "plot_axis.h"

#include <algorithm>
#include <cmath>

namespace pcl_nurbs_tools {
namespace {

/** 1, 2 or 5 times a power of ten, for about six ticks. */
double
niceStep(double range)
{
  constexpr double kTicks = 6.0;
  const double power = std::pow(10.0, std::floor(std::log10(range / kTicks)));
  for (const double step : {1.0, 2.0, 5.0})
    if (range / (step * power) <= kTicks)
      return step * power;
  return 10.0 * power;
}

} // namespace

Axis
axisOver(double low, double high)
{
  constexpr double kMargin = 0.04;
  Axis axis;
  if (!(low <= high))
    return axis;
  const double range = high > low ? high - low : std::max(1.0, std::abs(high));
  axis.low = low - kMargin * range;
  axis.high = high + kMargin * range;
  axis.tick = niceStep(range);
  return axis;
}

void
widen(Axis& axis, double range)
{
  const double middle = 0.5 * (axis.low + axis.high);
  axis.low = middle - 0.5 * range;
  axis.high = middle + 0.5 * range;
  axis.tick = niceStep(range);
}

} // namespace pcl_nurbs_tools
