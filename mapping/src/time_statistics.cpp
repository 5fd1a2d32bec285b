// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pipeline/time_statistics.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kShortest = 1e-6; // seconds
constexpr double kGrowth = 1.02;

} // namespace

void
TimeStatistics::add(double seconds)
{
  const double bin =
      std::log(std::max(seconds, kShortest) / kShortest) / std::log(kGrowth);
  ++bins_[std::min(static_cast<std::size_t>(bin), kBins - 1)];
  ++count_;
  sum_ += seconds;
  max_ = std::max(max_, seconds);
}

double
TimeStatistics::percentile(double share) const
{
  if (!(share >= 0.0 && share <= 1.0))
    throw std::invalid_argument("TimeStatistics: a share is 0 to 1");
  const double wanted = share * static_cast<double>(count_);
  double below = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    below += static_cast<double>(bins_[bin]);
    if (bins_[bin] > 0 && below >= wanted)
      return std::min(kShortest * std::pow(kGrowth, static_cast<double>(bin) + 0.5),
                      max_);
  }
  return max_;
}

} // namespace nurbs
} // namespace pcl
