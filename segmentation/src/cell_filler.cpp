// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "cell_filler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::int32_t kEmpty = -1;

class Filler {
public:
  Filler(const GridGeometry& grid, const ChartList& charts, const Rings& rings)
      : charts_(charts), rings_(rings), layout_{grid, {}, 0}
  {
    layout_.cell_point.assign(static_cast<std::size_t>(grid.width) *
                                  static_cast<std::size_t>(grid.height),
                              kEmpty);
  }

  GridLayout
  run()
  {
    for (std::size_t i = 0; i < charts_.size(); ++i)
      if (charts_[i].allFinite())
        placeNearest(static_cast<std::int32_t>(i));
    for (const std::int32_t loser : losers_)
      if (!placeBeside(loser))
        ++layout_.dropped;
    return std::move(layout_);
  }

private:
  Eigen::Vector2d
  cellOf(std::int32_t point) const
  {
    const auto index = static_cast<std::size_t>(point);
    Eigen::Vector2d cell =
        layout_.geometry.cell(charts_[index].x(), charts_[index].y());
    if (rings_)
      cell.y() = rings_.ring[index];
    return cell;
  }

  /** The content of a cell, or nothing when it is outside. */
  std::int32_t*
  at(int column, int row)
  {
    const GridGeometry& grid = layout_.geometry;
    if (grid.wrap)
      column = (column + grid.width) % grid.width;
    if (column < 0 || row < 0 || column >= grid.width || row >= grid.height)
      return nullptr;
    return &layout_.cell_point[static_cast<std::size_t>(row) *
                                   static_cast<std::size_t>(grid.width) +
                               static_cast<std::size_t>(column)];
  }

  void
  placeNearest(std::int32_t point)
  {
    const Eigen::Vector2d cell = cellOf(point).array().round();
    // Far outliers are outside of the raster and of the range of int.
    const Eigen::Vector2d limit(layout_.geometry.width, layout_.geometry.height);
    std::int32_t* place =
        (cell.array() >= -1.0).all() && (cell.array() <= limit.array()).all()
            ? at(static_cast<int>(cell.x()), static_cast<int>(cell.y()))
            : nullptr;
    if (place == nullptr) {
      ++layout_.dropped;
      return;
    }
    if (*place == kEmpty) {
      *place = point;
      return;
    }
    const auto depth = [this](std::int32_t i) {
      return charts_[static_cast<std::size_t>(i)].z();
    };
    if (depth(point) < depth(*place))
      std::swap(point, *place);
    losers_.push_back(point);
  }

  bool
  placeBeside(std::int32_t point)
  {
    const Eigen::Vector2d exact = cellOf(point);
    const int column = static_cast<int>(std::round(exact.x()));
    const int row = static_cast<int>(std::round(exact.y()));
    const int side = exact.x() >= column ? 1 : -1;
    const int below = exact.y() >= row ? 1 : -1;
    if (rings_)
      return placeFirst(point, {{column + side, row}, {column - side, row}});
    return placeFirst(point,
                      {{column + side, row},
                       {column, row + below},
                       {column + side, row + below},
                       {column - side, row}});
  }

  bool
  placeFirst(std::int32_t point, std::initializer_list<std::array<int, 2>> cells)
  {
    for (const auto& [column, row] : cells) {
      std::int32_t* place = at(column, row);
      if (place != nullptr && *place == kEmpty) {
        *place = point;
        return true;
      }
    }
    return false;
  }

  const ChartList& charts_;
  const Rings& rings_;
  GridLayout layout_;
  std::vector<std::int32_t> losers_;
};

} // namespace

GridLayout
fillCells(const GridGeometry& grid, const ChartList& charts, const Rings& rings)
{
  return Filler(grid, charts, rings).run();
}

int
typicalGap(const GridLayout& layout)
{
  constexpr int kMost = 8;
  std::array<std::size_t, kMost + 1> counts{};
  const auto width = static_cast<std::size_t>(layout.geometry.width);
  std::size_t all = 0;
  int gap = kMost + 1;
  for (std::size_t i = 0; i < layout.cell_point.size(); ++i) {
    gap = i % width == 0 ? kMost + 1 : gap + 1;
    if (layout.cell_point[i] == kEmpty)
      continue;
    if (gap <= kMost) {
      ++counts[static_cast<std::size_t>(gap)];
      ++all;
    }
    gap = 0;
  }
  std::size_t spanned = 0;
  for (int g = 1; g < kMost; ++g) {
    spanned += counts[static_cast<std::size_t>(g)];
    if (spanned * 20 >= all * 19)
      return g;
  }
  return kMost;
}

} // namespace nurbs
} // namespace pcl
