// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "disjoint_sets.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <queue>
#include <set>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {

/** Joins sets whose common border is smooth, the smoothest first. Borders of sets are
 * the sums of their members': one doubtful piece between two large surfaces does not
 * outvote the rest. */
class BorderAgglomeration {
public:
  explicit BorderAgglomeration(std::uint32_t sets) : neighbours_(sets) {}

  /** Add a piece of border of two different sets, so many cells long. */
  void
  add(std::uint32_t a, std::uint32_t b, std::size_t length, bool smooth);

  /** Join while at least a share of the border of two sets is smooth. */
  void
  joinInto(DisjointSets& sets, double least_share);

private:
  struct Border {
    std::size_t smooth = 0;
    std::size_t all = 0;

    double
    share() const
    {
      return static_cast<double>(smooth) / static_cast<double>(all);
    }
  };

  struct Candidate {
    double share;
    std::size_t length;
    std::uint32_t a;
    std::uint32_t b;

    bool
    operator<(const Candidate& other) const;
  };

  Border&
  border(std::uint32_t a, std::uint32_t b)
  {
    return borders_[std::minmax(a, b)];
  }

  void
  push(std::uint32_t a, std::uint32_t b, double least_share);

  void
  moveBorders(std::uint32_t from, std::uint32_t into, double least_share);

  std::map<std::pair<std::uint32_t, std::uint32_t>, Border> borders_;
  std::vector<std::set<std::uint32_t>> neighbours_;
  std::priority_queue<Candidate> queue_;
};

} // namespace nurbs
} // namespace pcl
