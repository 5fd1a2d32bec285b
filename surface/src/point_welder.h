// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Gives points that lie within a distance of each other one index.
 *
 * The first point of a group stands for it. Hash grid whose cells are much wider than
 * the distance, so that a query rarely looks at more than one cell.
 */
class PointWelder {
public:
  explicit PointWelder(double distance) : distance_(distance) {}

  /** \brief Index of the first known point within the distance, else of a new one. */
  int
  add(const Eigen::Vector3d& point);

  const Eigen::Vector3d&
  point(int index) const
  {
    return points_[static_cast<std::size_t>(index)];
  }

private:
  std::uint64_t
  cellOf(const Eigen::Vector3d& point) const;

  double distance_;
  std::vector<Eigen::Vector3d> points_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

} // namespace nurbs
} // namespace pcl
