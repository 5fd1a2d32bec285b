// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_geometry.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

using LabelImage = std::vector<std::uint32_t>;

/** Label that covers most of each true surface. */
inline std::map<std::uint32_t, std::uint32_t>
bestLabels(const LabelImage& truth, const LabelImage& labels)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> common;
  for (std::size_t i = 0; i < truth.size(); ++i)
    ++common[{truth[i], labels[i]}];
  std::map<std::uint32_t, std::size_t> most;
  std::map<std::uint32_t, std::uint32_t> best;
  for (const auto& [pair, count] : common)
    if (pair.second != 0 && count > most[pair.first]) {
      most[pair.first] = count;
      best[pair.first] = pair.second;
    }
  return best;
}

/** Cells of a true surface that do not have its best label. */
inline std::vector<std::size_t>
mismatches(const LabelImage& truth, const LabelImage& labels)
{
  std::map<std::uint32_t, std::uint32_t> best = bestLabels(truth, labels);
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (truth[i] != 0 && labels[i] != best[truth[i]])
      cells.push_back(i);
  return cells;
}

/** Share of the cells of true surfaces that have its best label; two surfaces under one
 * label count as wrong for the smaller one. */
inline double
accuracy(const LabelImage& truth, const LabelImage& labels)
{
  std::map<std::uint32_t, std::uint32_t> best = bestLabels(truth, labels);
  std::map<std::uint32_t, std::size_t> sizes;
  for (const std::uint32_t surface : truth)
    ++sizes[surface];
  std::map<std::uint32_t, std::uint32_t> owner; // of each label
  for (const auto& [surface, label] : best)
    if (owner.count(label) == 0 || sizes[surface] > sizes[owner[label]])
      owner[label] = surface;
  std::size_t right = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    right += truth[i] != 0 && labels[i] != 0 && owner.count(labels[i]) != 0 &&
                     owner[labels[i]] == truth[i]
                 ? 1
                 : 0;
  return static_cast<double>(right) / static_cast<double>(truth.size() - sizes[0]);
}

/** Chessboard distance, up to 16, to the nearest cell of another true surface. */
inline int
distanceToOther(const GridGeometry& grid, const LabelImage& truth, std::size_t cell)
{
  const int column = static_cast<int>(cell) % grid.width;
  const int row = static_cast<int>(cell) / grid.width;
  for (int far = 1; far < 16; ++far)
    for (int r = std::max(0, row - far); r <= std::min(grid.height - 1, row + far); ++r)
      for (int c = std::max(0, column - far);
           c <= std::min(grid.width - 1, column + far);
           ++c)
        if (truth[static_cast<std::size_t>(r * grid.width + c)] != truth[cell])
          return far;
  return 16;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
