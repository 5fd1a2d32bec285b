// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace pcl {
namespace nurbs {

/** \brief Mean, largest and percentiles of durations, in constant memory however many
 * there are.
 *
 * Mean and largest are exact. Durations are counted in bins whose borders grow by 2 %,
 * from a microsecond to a day, so a percentile is off by 1 % at most; what is shorter
 * counts as a microsecond there. A plain value. \ingroup mapping */
class PCL_NURBS_MAPPING_EXPORT TimeStatistics {
public:
  /** \brief Count a duration, seconds. O(1) */
  void
  add(double seconds);

  std::size_t
  count() const
  {
    return count_;
  }

  /** \brief Seconds; 0 for none. */
  double
  mean() const
  {
    return count_ > 0 ? sum_ / static_cast<double>(count_) : 0.0;
  }

  /** \brief Seconds; 0 for none. */
  double
  max() const
  {
    return max_;
  }

  /** \brief The duration that a share of them does not exceed; 0 for none.
   * \param[in] share 0 .. 1 \throws std::invalid_argument for another share. O(1) */
  double
  percentile(double share) const;

private:
  static constexpr std::size_t kBins = 1280;

  std::array<std::uint64_t, kBins> bins_{};
  std::size_t count_ = 0;
  double sum_ = 0.0;
  double max_ = 0.0;
};

} // namespace nurbs
} // namespace pcl
