// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "progress_bar.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace pcl_nurbs_tools {

ProgressBar::ProgressBar(std::string label, bool quiet)
    : label_(std::move(label)), enabled_(!quiet && isatty(STDERR_FILENO) != 0)
{
}

ProgressBar::~ProgressBar()
{
  if (drawn_)
    std::fprintf(stderr, "\r\033[K");
}

void
ProgressBar::update(double share)
{
  constexpr int kWidth = 40;
  const Clock::time_point now = Clock::now();
  if (!enabled_ || now < next_)
    return;
  next_ = now + std::chrono::milliseconds(200);
  drawn_ = true;
  const int filled = static_cast<int>(std::lround(share * kWidth));
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double left = share > 0.0 ? elapsed * (1.0 - share) / share : 0.0;
  std::fprintf(stderr,
               "\r%s [%.*s%*s] %3.0f %%, %.0f s left \033[K",
               label_.c_str(),
               filled,
               "========================================",
               kWidth - filled,
               "",
               100.0 * share,
               left);
}

} // namespace pcl_nurbs_tools
