// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "border_sampling.h"
#include "polygon_index.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief What a cell of the grid has to do with the border of its patch. */
enum class Cell : std::uint8_t { Outside, Full, Border };

/** \brief The cells of a grid, told apart by where the border runs. */
class GridCells {
public:
  GridCells(const SurfaceGrid& grid, const std::vector<BorderLoop>& loops);

  /** \brief Kind of a cell; Outside beyond the grid. */
  Cell
  at(int i, int j) const
  {
    if (i < 0 || j < 0 || i >= grid_.cellsU() || j >= grid_.cellsV())
      return Cell::Outside;
    return cells_[index(i, j)];
  }

  /** \brief Whether the border runs along sides of cells only. */
  bool
  areAllWhole() const;

  /** \brief Parameters of a grid point. */
  Eigen::Vector2d
  point(int i, int j) const
  {
    return {grid_.u()[static_cast<std::size_t>(i)],
            grid_.v()[static_cast<std::size_t>(j)]};
  }

  /** \brief Parameters in units in which the larger side of the domain is 1 and both
   * directions are as long as in space, so that triangles that are good in them are
   * good in space. */
  Eigen::Vector2d
  scaled(const Eigen::Vector2d& uv) const
  {
    return (uv - origin_).cwiseProduct(scale_);
  }

  /** \brief Inverse of scaled(). */
  Eigen::Vector2d
  unscaled(const Eigen::Vector2d& position) const
  {
    return origin_ + position.cwiseQuotient(scale_);
  }

  /** \brief Whether a scaled position is inside of the border or close to it. */
  bool
  isInside(const Eigen::Vector2d& position) const
  {
    return inside_->contains(position);
  }

  /** \brief Whether a scaled position is inside and not close to the border. Closer
   * points would make slivers, and might split an edge that another patch has whole. */
  bool
  isWellInside(const Eigen::Vector2d& position) const
  {
    return inside_->contains(position) && !inside_->isOnBorder(position);
  }

private:
  std::size_t
  index(int i, int j) const
  {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(grid_.cellsV()) +
           static_cast<std::size_t>(j);
  }

  void
  chooseScale();
  void
  markSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b);
  void
  indexBorder(const std::vector<BorderLoop>& loops);

  const SurfaceGrid& grid_;
  std::vector<Cell> cells_;
  Eigen::Vector2d origin_;
  Eigen::Vector2d scale_;
  std::optional<PolygonIndex> inside_;
};

/** \brief Whether \a cell coordinates are those of a grid point. */
bool
isGridPoint(const Eigen::Vector2d& cell);

} // namespace nurbs
} // namespace pcl
