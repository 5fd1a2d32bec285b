// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <chrono>

namespace pcl {
namespace nurbs {

/** \brief Wall-clock time between laps.
 * \ingroup mapping */
class StopWatch {
public:
  /** \brief Seconds since construction or the last lap. */
  double
  lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace nurbs
} // namespace pcl
