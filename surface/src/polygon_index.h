// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Winding numbers around a set of closed polygons.
 *
 * The range of v is cut into bands that each list the edges they meet, so a query reads
 * only the edges near its own v. The number of bands grows with the edges as long as
 * the lists stay linear in total, which bounds memory for combs of long edges.
 */
class PolygonIndex {
public:
  /** \param[in] polygons corners in order, first not repeated
   * \param[in] border_tolerance points that close to an edge are inside */
  PolygonIndex(const std::vector<std::vector<Eigen::Vector2d>>& polygons,
               double border_tolerance);

  /** \brief Whether the winding number is not zero or the point is on the border. */
  bool
  contains(const Eigen::Vector2d& point) const;

  /** \brief Whether the point is within the border tolerance of an edge. */
  bool
  isOnBorder(const Eigen::Vector2d& point) const;

private:
  struct Edge {
    Eigen::Vector2d from, to;
  };

  bool
  isNear(const Edge& edge, const Eigen::Vector2d& point) const;

  std::size_t
  band(double v) const;

  void
  chooseBands(const std::vector<Edge>& edges);

  double tolerance_;
  double v_low_ = 0.0;
  double v_high_ = -1.0; // empty
  double bands_per_v_ = 0.0;
  std::vector<std::size_t> first_; // band b owns edges_[first_[b] .. first_[b + 1])
  std::vector<Edge> edges_;
};

} // namespace nurbs
} // namespace pcl
