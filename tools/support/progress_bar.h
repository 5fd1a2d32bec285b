// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <chrono>
#include <string>

namespace pcl_nurbs_tools {

/** A bar on stderr for work of more than two seconds, if stderr is a terminal. */
class ProgressBar {
public:
  ProgressBar(std::string label, bool quiet);

  /** Leaves the line empty. */
  ~ProgressBar();

  ProgressBar(const ProgressBar&) = delete;
  ProgressBar&
  operator=(const ProgressBar&) = delete;

  /** \param[in] share of the work done, 0 to 1 */
  void
  update(double share);

private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  bool enabled_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_ + std::chrono::seconds(2);
};

} // namespace pcl_nurbs_tools
