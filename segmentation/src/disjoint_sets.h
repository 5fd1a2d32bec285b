// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace pcl {
namespace nurbs {

/** Disjoint sets of numbers 0, 1, ..; the root of a set is its smallest member. */
class DisjointSets {
public:
  explicit DisjointSets(std::size_t count = 0) : parent_(count)
  {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  /** Add numbers, each a set of its own, until there are so many. */
  void
  grow(std::size_t count)
  {
    const std::size_t before = parent_.size();
    parent_.resize(count);
    std::iota(parent_.begin() + static_cast<std::ptrdiff_t>(before),
              parent_.end(),
              static_cast<std::uint32_t>(before));
  }

  std::size_t
  size() const
  {
    return parent_.size();
  }

  std::uint32_t
  find(std::uint32_t member)
  {
    while (parent_[member] != member) {
      parent_[member] = parent_[parent_[member]];
      member = parent_[member];
    }
    return member;
  }

  /** \return root of the joint set */
  std::uint32_t
  join(std::uint32_t a, std::uint32_t b)
  {
    if (parent_[a] == parent_[b])
      return find(a);
    a = find(a);
    b = find(b);
    const std::uint32_t root = std::min(a, b);
    parent_[std::max(a, b)] = root;
    return root;
  }

private:
  std::vector<std::uint32_t> parent_;
};

} // namespace nurbs
} // namespace pcl
