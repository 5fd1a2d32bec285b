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
  Filler(const GridGeometry& grid, const ChartList& charts)
      : charts_(charts), layout_{grid, {}, 0}
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
    return layout_.geometry.cell(charts_[index].x(), charts_[index].y());
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
  GridLayout layout_;
  std::vector<std::int32_t> losers_;
};

/** A reading of a ring and the column, not rounded, where it lies. */
struct RingReading {
  double column;
  std::int32_t point;
};

/** Columns that keep the order of a ring's readings, one each, and move them least: the
 * isotonic least squares fit of where each lies less its rank, by pooling adjacent
 * violators (Ayer, Brunk, Ewing, Reid and Silverman, 1955). */
std::vector<int>
packedColumns(const std::vector<RingReading>& readings)
{
  struct Block {
    double sum;
    int count;
  };
  std::vector<Block> blocks;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    blocks.push_back({readings[k].column - static_cast<double>(k), 1});
    while (blocks.size() > 1) {
      const Block last = blocks.back();
      Block& before = blocks[blocks.size() - 2];
      if (before.sum * last.count <= last.sum * before.count)
        break;
      before.sum += last.sum;
      before.count += last.count;
      blocks.pop_back();
    }
  }
  std::vector<int> columns;
  columns.reserve(readings.size());
  for (const Block& block : blocks) {
    const int shift = static_cast<int>(std::lround(block.sum / block.count));
    for (int k = 0; k < block.count; ++k)
      columns.push_back(shift + static_cast<int>(columns.size()));
  }
  return columns;
}

/** Readings of each ring from left to right. */
std::vector<std::vector<RingReading>>
sortedRings(const GridGeometry& grid, const ChartList& charts, const Rings& rings)
{
  std::vector<std::vector<RingReading>> rows(static_cast<std::size_t>(grid.height));
  for (std::size_t i = 0; i < charts.size(); ++i)
    if (rings.ring[i] >= 0 && charts[i].allFinite())
      rows[static_cast<std::size_t>(rings.ring[i])].push_back(
          {(charts[i].x() - grid.first_u) / grid.step_u, static_cast<std::int32_t>(i)});
  for (std::vector<RingReading>& row : rows)
    std::stable_sort(
        row.begin(), row.end(), [](const RingReading& a, const RingReading& b) {
          return a.column < b.column;
        });
  return rows;
}

/** Rows are rings: the turn of a laser is not quite even, so that readings share
 * columns here and leave them empty there. */
GridLayout
fillRings(const GridGeometry& grid, const ChartList& charts, const Rings& rings)
{
  constexpr double kMostShift = 2.0;
  GridLayout layout{grid, {}, 0};
  const auto width = static_cast<std::size_t>(grid.width);
  layout.cell_point.assign(width * static_cast<std::size_t>(grid.height), kEmpty);
  std::size_t first = 0;
  for (const std::vector<RingReading>& row : sortedRings(grid, charts, rings)) {
    const std::vector<int> columns = packedColumns(row);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const bool placed = columns[k] >= 0 && columns[k] < grid.width &&
                          std::abs(columns[k] - row[k].column) <= kMostShift;
      if (placed)
        layout.cell_point[first + static_cast<std::size_t>(columns[k])] = row[k].point;
      else
        ++layout.dropped;
    }
    first += width;
  }
  return layout;
}

} // namespace

GridLayout
fillCells(const GridGeometry& grid, const ChartList& charts, const Rings& rings)
{
  return rings ? fillRings(grid, charts, rings) : Filler(grid, charts).run();
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
