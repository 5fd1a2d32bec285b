// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "mask_operations.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::array<std::array<int, 2>, 4> kSides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

std::size_t
indexOf(const CellMask& mask, int column, int row)
{
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.width) +
         static_cast<std::size_t>(column);
}

/** Close cells with at least six of eight neighbours. */
CellMask
withoutPinholes(const CellMask& mask)
{
  constexpr int kMostNeighbours = 6;
  CellMask result = mask;
  for (int row = 0; row < mask.height; ++row)
    for (int column = 0; column < mask.width; ++column) {
      int neighbours = 0;
      for (int dr = -1; dr <= 1; ++dr)
        for (int dc = -1; dc <= 1; ++dc)
          neighbours += (dr != 0 || dc != 0) && mask.at(column + dc, row + dr) ? 1 : 0;
      if (neighbours >= kMostNeighbours)
        result.cells[indexOf(mask, column, row)] = 1;
    }
  return result;
}

/** The mask in the middle of a frame of empty cells. */
CellMask
framed(const CellMask& mask, int margin)
{
  CellMask result;
  result.width = mask.width + 2 * margin;
  result.height = mask.height + 2 * margin;
  result.cells.assign(static_cast<std::size_t>(result.width) *
                          static_cast<std::size_t>(result.height),
                      0);
  for (int row = 0; row < mask.height; ++row)
    std::copy_n(mask.cells.begin() + static_cast<std::ptrdiff_t>(indexOf(mask, 0, row)),
                mask.width,
                result.cells.begin() +
                    static_cast<std::ptrdiff_t>(indexOf(result, margin, row + margin)));
  return result;
}

/** Set, along one line of cells, everything at most \a radius from a cell of this
 * \a value to that value. */
void
spread(char* first, int count, std::ptrdiff_t stride, int radius, char value)
{
  std::vector<int> since(static_cast<std::size_t>(count));
  int steps = radius;
  for (int k = 0; k < count; ++k) {
    steps = first[k * stride] == value ? 0 : steps + 1;
    since[static_cast<std::size_t>(k)] = steps;
  }
  steps = radius;
  for (int k = count; k-- > 0;) {
    steps = first[k * stride] == value ? 0 : steps + 1;
    if (std::min(steps, since[static_cast<std::size_t>(k)]) <= radius)
      first[k * stride] = value;
  }
}

/** spread() over squares: along rows, then along columns. */
void
spread(CellMask& mask, int radius, char value)
{
  for (int row = 0; row < mask.height; ++row)
    spread(&mask.cells[indexOf(mask, 0, row)], mask.width, 1, radius, value);
  for (int column = 0; column < mask.width; ++column)
    spread(
        &mask.cells[indexOf(mask, column, 0)], mask.height, mask.width, radius, value);
}

/** Collects a connected part, in no order; takes its cells from the waiting ones. */
class PartCollector {
public:
  PartCollector(const GridGeometry& geometry, std::vector<char>& waiting)
      : geometry_(geometry), waiting_(waiting)
  {
  }

  std::vector<std::int32_t>
  collect(std::int32_t start)
  {
    part_.clear();
    take(start % geometry_.width, start / geometry_.width);
    const int gap = geometry_.max_gap;
    for (std::size_t k = 0; k < part_.size(); ++k) {
      const int column = part_[k] % geometry_.width;
      const int row = part_[k] / geometry_.width;
      if (gap == 1)
        for (const auto& [dc, dr] : kSides)
          take(column + dc, row + dr);
      else
        for (int dr = -gap; dr <= gap; ++dr)
          for (int dc = -gap; dc <= gap; ++dc)
            take(column + dc, row + dr);
    }
    return std::move(part_);
  }

private:
  void
  take(int column, int row)
  {
    if (geometry_.wrap)
      column = (column + geometry_.width) % geometry_.width;
    if (column < 0 || row < 0 || column >= geometry_.width || row >= geometry_.height)
      return;
    const std::int32_t cell = row * geometry_.width + column;
    if (waiting_[static_cast<std::size_t>(cell)] == 0)
      return;
    waiting_[static_cast<std::size_t>(cell)] = 0;
    part_.push_back(cell);
  }

  const GridGeometry& geometry_;
  std::vector<char>& waiting_;
  std::vector<std::int32_t> part_;
};

} // namespace

CellMask
closed(const CellMask& mask, int gap)
{
  const int radius = gap / 2;
  if (radius == 0)
    return withoutPinholes(mask);
  CellMask wide = framed(mask, 2 * radius);
  spread(wide, radius, 1);
  spread(wide, radius, 0);
  CellMask result = mask;
  for (int row = 0; row < mask.height; ++row)
    for (int column = 0; column < mask.width; ++column)
      result.cells[indexOf(mask, column, row)] =
          wide.cells[indexOf(wide, column + 2 * radius, row + 2 * radius)];
  return withoutPinholes(result);
}

void
clearSmallParts(CellMask& mask, const CellMask& samples, int fewest)
{
  GridGeometry grid;
  grid.width = mask.width;
  grid.height = mask.height;
  std::vector<char> waiting = mask.cells;
  PartCollector collector(grid, waiting);
  for (std::size_t start = 0; start < mask.cells.size(); ++start) {
    if (waiting[start] == 0)
      continue;
    const std::vector<std::int32_t> part =
        collector.collect(static_cast<std::int32_t>(start));
    const auto count = std::count_if(part.begin(), part.end(), [&](std::int32_t cell) {
      return samples.cells[static_cast<std::size_t>(cell)] != 0;
    });
    if (count < fewest)
      for (const std::int32_t cell : part)
        mask.cells[static_cast<std::size_t>(cell)] = 0;
  }
}

std::vector<std::vector<std::int32_t>>
connectedParts(const GridGeometry& geometry,
               const std::vector<std::int32_t>& cells,
               std::vector<char>& scratch)
{
  scratch.resize(static_cast<std::size_t>(geometry.width) *
                     static_cast<std::size_t>(geometry.height),
                 0);
  for (const std::int32_t cell : cells)
    scratch[static_cast<std::size_t>(cell)] = 1;
  PartCollector collector(geometry, scratch);
  std::vector<std::vector<std::int32_t>> parts;
  for (const std::int32_t start : cells)
    if (scratch[static_cast<std::size_t>(start)] != 0)
      parts.push_back(collector.collect(start));
  for (std::vector<std::int32_t>& part : parts)
    std::sort(part.begin(), part.end());
  return parts;
}

} // namespace nurbs
} // namespace pcl
