// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "occupancy_grid.h"

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** A shift of a scan, in cells, and how well the scan fits there. */
struct ShiftFit {
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();
  int fit = -1;
};

/** Finds the shift along the axes at which placed points fit an occupancy grid best.
 *
 * All shifts of a lattice are summed at once: where one point comes to lie for shifts
 * along x are neighbours in memory, because cells are stored by their remainder. */
class ShiftLattice {
public:
  /** Shifts along x that are summed at once. */
  static constexpr int kLanes = 16;

  /** \param[in] max_shift cells along each axis, a multiple of the step
   * \param[in] step cells; at most kLanes shifts along an axis
   * \throws std::invalid_argument for another lattice */
  ShiftLattice(const OccupancyGrid& grid, int max_shift, int step);

  /** The best of the lattice's shifts; the first of equal ones. Points that are outside
   * of the grid before they are shifted count nothing. */
  ShiftFit
  best(const ScanPoints& placed) const;

private:
  /** Where a cell is stored, by its coordinates in the padded grid. */
  std::size_t
  indexOf(std::size_t x, std::size_t y, std::size_t z) const
  {
    return (z * edge_ + y) * edge_ + (x % step_) * (edge_ / step_) + x / step_;
  }

  void
  add(std::size_t cell, std::vector<std::uint16_t>& sums) const;

  int max_shift_;
  std::size_t step_;
  std::size_t shifts_; // along an axis
  std::size_t edge_;   // of the padded grid
  std::vector<std::uint8_t> cells_;
};

} // namespace nurbs
} // namespace pcl
