// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

namespace pcl_nurbs_tools {

/** Interval of one axis and the distance of its ticks. */
struct Axis {
  double low = 0.0;
  double high = 1.0;
  double tick = 0.2;
};

/** Axis over an interval with a margin and round ticks; any axis if \a low > \a high.
 */
Axis
axisOver(double low, double high);

/** Stretch an axis about its middle to a range. */
void
widen(Axis& axis, double range);

} // namespace pcl_nurbs_tools
