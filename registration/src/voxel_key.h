// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace pcl {
namespace nurbs {

/** Cells on either side of the origin that a key has room for, with a margin for the
 * neighbours of the outermost ones. */
constexpr double kMaxCell = 1000000.0;

/** The cell of a place; none when it is not finite or too far away. */
inline std::optional<Eigen::Vector3i>
voxelCell(const Eigen::Vector3d& place, double inverse_size)
{
  const Eigen::Array3d scaled = (place * inverse_size).array();
  if (!(scaled.abs() < kMaxCell).all()) // NaN compares false
    return std::nullopt;
  // Truncation and a correction, as floor() is a library call without SSE 4.1.
  const Eigen::Array3i whole = scaled.cast<int>();
  return whole - (scaled < whole.cast<double>()).cast<int>();
}

/** 21 bits per coordinate. */
inline std::uint64_t
voxelKey(const Eigen::Vector3i& cell)
{
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21U) - 1;
  const auto bits = [](int value) { return static_cast<std::uint64_t>(value) & kMask; };
  return bits(cell.x()) | bits(cell.y()) << 21U | bits(cell.z()) << 42U;
}

/** Fibonacci hashing: the high bits of the product depend on all of the key's. */
inline std::size_t
voxelHash(std::uint64_t key)
{
  return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 32U);
}

/** Put a key that is not there yet in a table of open addressing. */
template <typename Slot>
void
addToTable(std::vector<Slot>& table, std::uint64_t key, std::int32_t voxel)
{
  const std::size_t mask = table.size() - 1;
  std::size_t i = voxelHash(key) & mask;
  while (table[i].voxel >= 0)
    i = (i + 1) & mask;
  table[i] = {key, voxel};
}

} // namespace nurbs
} // namespace pcl
