// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "noise_dispersion.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Sums of a lattice of blocks, empty where there is no node. */
struct BlockSums {
  std::size_t across = 0;
  std::size_t down = 0;
  std::vector<std::optional<ViewSums>> sums;

  BlockSums(std::size_t columns, std::size_t rows)
      : across(columns), down(rows), sums(columns * rows)
  {
  }

  /** The four blocks of a square, if all are there. */
  std::optional<std::array<const ViewSums*, 4>>
  square(std::size_t column, std::size_t row) const
  {
    const std::size_t first = row * across + column;
    std::array<const ViewSums*, 4> result{};
    std::size_t next = 0;
    for (const std::size_t block :
         {first, first + 1, first + across, first + across + 1}) {
      if (!sums[block])
        return std::nullopt;
      result[next++] = &*sums[block];
    }
    return result;
  }
};

BlockSums
blocksOf(const GridGeometry& grid, const SurfaceNodes& nodes, BlockSize size)
{
  const auto width = static_cast<std::size_t>(grid.width);
  const auto columns = static_cast<std::size_t>(size.columns);
  const auto rows = static_cast<std::size_t>(size.rows);
  BlockSums blocks((width + columns - 1) / columns,
                   (static_cast<std::size_t>(grid.height) + rows - 1) / rows);
  for (std::uint32_t node = 0; node < nodes.count(); ++node)
    blocks.sums[nodes.block(node)] = nodes.sums(node);
  return blocks;
}

/** Blocks twice as wide and high. */
BlockSums
coarser(const BlockSums& fine)
{
  BlockSums blocks(fine.across / 2, fine.down / 2);
  for (std::size_t row = 0; row < blocks.down; ++row)
    for (std::size_t column = 0; column < blocks.across; ++column)
      if (const auto square = fine.square(2 * column, 2 * row)) {
        ViewSums sums;
        for (const ViewSums* block : *square)
          sums += *block;
        blocks.sums[row * blocks.across + column] = sums;
      }
  return blocks;
}

/** Lower quantile of what a coefficient saves; nothing if there are few squares. */
std::optional<double>
savedPerCoefficient(const BlockSums& blocks, int terms)
{
  constexpr double kQuantile = 0.3;
  constexpr std::size_t kEnough = 30;
  constexpr double kLocalTerms = 6.0; // of a laser's nine, locally
  const double coefficients = 3.0 * std::min<double>(terms, kLocalTerms);
  std::vector<double> saved;
  for (std::size_t row = 0; row + 1 < blocks.down; ++row)
    for (std::size_t column = 0; column + 1 < blocks.across; ++column)
      if (const auto square = blocks.square(column, row)) {
        ViewSums all;
        double apart = 0.0;
        for (const ViewSums* block : *square) {
          all += *block;
          apart += block->misfit(block->fit(terms));
        }
        saved.push_back((all.misfit(all.fit(terms)) - apart) / coefficients);
      }
  if (saved.size() < kEnough)
    return std::nullopt;
  const auto where = saved.begin() + static_cast<std::ptrdiff_t>(
                                         kQuantile * static_cast<double>(saved.size()));
  std::nth_element(saved.begin(), where, saved.end());
  return *where;
}

} // namespace

double
noiseDispersion(const GridGeometry& grid,
                const SurfaceNodes& nodes,
                const ViewChart& chart,
                BlockSize size)
{
  constexpr double kLeast = 0.25;
  const int terms = chart.termChoices()[1];
  const BlockSums fine = blocksOf(grid, nodes, size);
  std::optional<double> result = savedPerCoefficient(coarser(fine), terms);
  if (!result)
    result = savedPerCoefficient(fine, terms);
  return std::max(result.value_or(1.0), kLeast);
}

} // namespace nurbs
} // namespace pcl
