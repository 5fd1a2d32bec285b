// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/voxel_map.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** A coarse picture of a map around a place, in which a scan's fit at a pose costs a
 * look per point: cells that hold points count most, their neighbours less. */
class OccupancyGrid {
public:
  /** Cells along an edge. */
  static constexpr int kEdge = 64;

  OccupancyGrid(const std::vector<Eigen::Vector3d>& points,
                const Eigen::Vector3d& center,
                double cell_size);

  /** The most that one point adds to a fit. */
  static constexpr int kLevels = 3;

  double
  cellSize() const
  {
    return cell_size_;
  }

  /** What a point in a cell adds. */
  std::uint8_t
  level(std::size_t x, std::size_t y, std::size_t z) const
  {
    return levels_[(z * kEdge + y) * kEdge + x];
  }

  /** Points at a pose, in cells from the grid's corner. */
  ScanPoints
  placed(const ScanPoints& scan, const Eigen::Isometry3d& pose) const;

  /** Sum over a scan's points at a pose of how near to occupied cells they are; points
   * outside count nothing. */
  int
  fit(const ScanPoints& scan, const Eigen::Isometry3d& pose) const;

private:
  void
  mark(const Eigen::Vector3d& point);

  /** Each cell becomes at least its neighbours' level less one. */
  void
  spread();

  void
  spreadAlong(std::size_t stride, std::vector<std::uint8_t>& levels) const;

  double cell_size_;
  Eigen::Vector3d corner_;
  std::vector<std::uint8_t> levels_;
};

} // namespace nurbs
} // namespace pcl
