// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/registration/motion_threshold.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {

MotionThreshold::MotionThreshold(const MotionThresholdOptions& options)
    : options_(options), sum_of_squares_(options.initial * options.initial)
{
}

void
MotionThreshold::addDeviation(const Eigen::Isometry3d& deviation)
{
  const double angle = Eigen::AngleAxisd(deviation.linear()).angle();
  const double way =
      deviation.translation().norm() + 2.0 * options_.max_range * std::sin(0.5 * angle);
  if (way <= options_.min_motion)
    return;
  sum_of_squares_ += way * way;
  count_ += 1.0;
}

double
MotionThreshold::value() const
{
  return std::clamp(3.0 * std::sqrt(sum_of_squares_ / count_),
                    options_.min_threshold,
                    options_.max_threshold);
}

} // namespace nurbs
} // namespace pcl
