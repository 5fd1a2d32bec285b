// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace pcl {
namespace nurbs {

/** A rectangle on the ground: from a corner along x (the front) and to the back. */
struct Plot {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
  double width = 0.0;
  double depth = 0.0;

  Eigen::Vector2d
  back() const
  {
    return {-along.y(), along.x()};
  }

  std::array<Eigen::Vector2d, 4>
  corners() const
  {
    const Eigen::Vector2d x = width * along;
    const Eigen::Vector2d y = depth * back();
    return {corner, corner + x, corner + x + y, corner + y};
  }

  /** Distance of a place, 0 inside. */
  double
  distance(const Eigen::Vector2d& place) const;
};

/** Plots that are taken; a place or plot is compared with those in cells nearby. */
class TownPlots {
public:
  void
  add(const Plot& plot);

  /** Whether a plot overlaps none that is taken. */
  bool
  isFree(const Plot& plot) const;

  /** Distance of a place from the nearest plot taken, at most \a most. */
  double
  clearance(const Eigen::Vector2d& place, double most) const;

private:
  template <typename Visit>
  void
  visitCells(const Plot& plot, double margin, const Visit& visit) const;

  std::vector<Plot> plots_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

} // namespace nurbs
} // namespace pcl
