// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pipeline/weak_intervals.h>

#include <algorithm>

namespace pcl {
namespace nurbs {

void
addWeakScan(std::vector<WeakInterval>& intervals,
            const WeakInterval& scan,
            std::size_t previous)
{
  if (intervals.empty() || intervals.back().weakness != scan.weakness ||
      intervals.back().last != previous) {
    intervals.push_back(scan);
    return;
  }
  WeakInterval& last = intervals.back();
  last.last = scan.last;
  last.to = scan.to;
  last.directions = std::max(last.directions, scan.directions);
}

} // namespace nurbs
} // namespace pcl
