// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "mask_boundary.h"
#include "segment_fitting.h"

#include <pcl/segmentation/grid_geometry.h>

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Rectangle of the grid around a set of cells; columns may run over the seam of
 * a scan that closes on itself. */
class GridWindow {
public:
  GridWindow(const GridGeometry& geometry, const CellSet& cells) : geometry_(geometry)
  {
    std::vector<char> used(static_cast<std::size_t>(geometry.width), 0);
    int row_low = geometry.height;
    int row_high = 0;
    for (std::int32_t cell : cells) {
      used[static_cast<std::size_t>(cell % geometry.width)] = 1;
      row_low = std::min(row_low, cell / geometry.width);
      row_high = std::max(row_high, cell / geometry.width);
    }
    first_row_ = row_low;
    mask.height = row_high - row_low + 1;
    chooseColumns(used);
    mask.cells.assign(static_cast<std::size_t>(mask.width) *
                          static_cast<std::size_t>(mask.height),
                      0);
  }

  /** \brief Column and row of a cell within the window. */
  Eigen::Vector2i
  place(std::int32_t cell) const
  {
    const int column =
        (cell % geometry_.width - first_column_ + geometry_.width) % geometry_.width;
    return {column, cell / geometry_.width - first_row_};
  }

  std::size_t
  index(const Eigen::Vector2i& place) const
  {
    return static_cast<std::size_t>(place.y()) * static_cast<std::size_t>(mask.width) +
           static_cast<std::size_t>(place.x());
  }

  Eigen::Vector2d
  origin() const
  {
    return {first_column_, first_row_};
  }

  CellMask mask;

private:
  /** \brief Start after the widest run of unused columns, counted around a closed scan.
   */
  void
  chooseColumns(const std::vector<char>& used)
  {
    const int width = geometry_.width;
    int best_length = -1;
    int best_end = 0;
    const int turns = geometry_.wrap ? 2 : 1;
    int length = 0;
    for (int k = 0; k < turns * width && geometry_.wrap; ++k) {
      length = used[static_cast<std::size_t>(k % width)] != 0 ? 0 : length + 1;
      if (length > best_length && length <= width) {
        best_length = length;
        best_end = (k + 1) % width;
      }
    }
    if (geometry_.wrap && best_length > 0) {
      first_column_ = best_end;
      mask.width = width - best_length;
      return;
    }
    const auto first = std::find(used.begin(), used.end(), 1);
    const auto last = std::find(used.rbegin(), used.rend(), 1);
    first_column_ = static_cast<int>(first - used.begin());
    mask.width = static_cast<int>(used.rend() - last) - first_column_;
  }

  const GridGeometry& geometry_;
  int first_column_ = 0;
  int first_row_ = 0;
};

} // namespace nurbs
} // namespace pcl
