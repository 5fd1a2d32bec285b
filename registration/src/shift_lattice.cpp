// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "shift_lattice.h"

#include <algorithm>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kEdge = OccupancyGrid::kEdge;

} // namespace

ShiftLattice::ShiftLattice(const OccupancyGrid& grid, int max_shift, int step)
    : max_shift_(max_shift), step_(static_cast<std::size_t>(std::max(step, 1)))
{
  if (step < 1 || max_shift < 0 || max_shift % step != 0 ||
      2 * max_shift / step + 1 > kLanes)
    throw std::invalid_argument("ShiftLattice: no such lattice");
  const auto pad = static_cast<std::size_t>(max_shift);
  shifts_ = 2 * pad / step_ + 1;
  edge_ = (kEdge + 2 * pad + step_ - 1) / step_ * step_;
  cells_.assign(edge_ * edge_ * edge_ + kLanes, 0);
  for (std::size_t z = 0; z < kEdge; ++z)
    for (std::size_t y = 0; y < kEdge; ++y)
      for (std::size_t x = 0; x < kEdge; ++x)
        cells_[indexOf(x + pad, y + pad, z + pad)] = grid.level(x, y, z);
}

void
ShiftLattice::add(std::size_t cell, std::vector<std::uint16_t>& sums) const
{
  std::uint16_t* sum = sums.data();
  const std::uint8_t* plane = cells_.data() + cell;
  for (std::size_t z = 0; z < shifts_; ++z, plane += step_ * edge_ * edge_) {
    const std::uint8_t* row = plane;
    for (std::size_t y = 0; y < shifts_; ++y, row += step_ * edge_, sum += kLanes)
      for (int lane = 0; lane < kLanes; ++lane)
        sum[lane] = static_cast<std::uint16_t>(sum[lane] + row[lane]);
  }
}

ShiftFit
ShiftLattice::best(const ScanPoints& placed) const
{
  constexpr auto kLast = static_cast<float>(kEdge);
  std::vector<std::uint16_t> sums(shifts_ * shifts_ * kLanes, 0);
  for (const Eigen::Vector3f& point : placed)
    if ((point.array() >= 0.0F).all() && (point.array() < kLast).all())
      // The padding is as wide as the farthest shift back.
      add(indexOf(static_cast<std::size_t>(point.x()),
                  static_cast<std::size_t>(point.y()),
                  static_cast<std::size_t>(point.z())),
          sums);
  ShiftFit best;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const std::size_t x = i % kLanes;
    if (x >= shifts_ || sums[i] <= best.fit)
      continue;
    const std::size_t y = i / kLanes % shifts_;
    const std::size_t z = i / kLanes / shifts_;
    best.fit = sums[i];
    best.shift = (Eigen::Array3f(x, y, z) * static_cast<float>(step_) -
                  static_cast<float>(max_shift_));
  }
  return best;
}

} // namespace nurbs
} // namespace pcl
