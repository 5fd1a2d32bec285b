// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/random_walk.h>

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** What two groups lose in balance when they become one, beside two single nodes:
 * scale [f(m) + f(n) - f(m + n) + f(2)], f(x) = x log x. */
class GroupBalance {
public:
  GroupBalance()
  {
    for (std::uint32_t size = 0; size < kTabulated; ++size)
      terms_.push_back(xLogX(size));
  }

  void
  setScale(double scale)
  {
    scale_ = scale;
  }

  /** \param[in] m,n number of nodes of the groups */
  double
  operator()(std::uint32_t m, std::uint32_t n) const
  {
    return scale_ * (term(m) + term(n) - term(m + n) + term(2));
  }

private:
  static constexpr std::uint32_t kTabulated = 4096;

  double
  term(std::uint32_t size) const
  {
    return size < kTabulated ? terms_[size] : xLogX(size);
  }

  std::vector<double> terms_; // of small groups
  double scale_ = 0.0;
};

} // namespace nurbs
} // namespace pcl
