// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace pcl {
namespace nurbs {

/** Edges whose gains are bounded from above together, several in one step of the
 * processor. Single precision is enough: only edges whose bounds are high enough need
 * their exact gains. */
struct EdgeBatch {
  static constexpr std::size_t kMost = 64;
  /** No bound is more than twice this above the exact gain, for weights up to 1. */
  static constexpr double kError = 4e-6;

  std::size_t count = 0;
  std::array<std::uint32_t, kMost> place; // in the list of edges they are from
  /** Weights of the edge and of the loops at its ends, in units of any weight that no
   * loop exceeds. */
  std::array<float, kMost> weight;
  std::array<float, kMost> loop_a;
  std::array<float, kMost> loop_b;
  std::array<double, kMost> balance;
  std::array<std::uint32_t, kMost> nodes; // size of both groups
  std::array<float, kMost> gain;          // bound of scaledEdgeGain() in the same unit

  /** Find \a gain of all. Places beyond \a count are computed as well. */
  void
  boundGains();
};

} // namespace nurbs
} // namespace pcl
