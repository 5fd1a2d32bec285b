// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "integer_grid.h"

#include <limits>

namespace pcl {
namespace nurbs {
namespace {

constexpr int kMaxOrder = 2;

/** In place, down the rows: differences as if zeros stood before the first row. */
void
differenceRows(IntegerGrid& grid)
{
  for (int i = grid.rows - 1; i > 0; --i)
    for (int j = 0; j < grid.cols; ++j)
      grid.at(i, j) = wrappingSubtract(grid.at(i, j), grid.at(i - 1, j));
}

void
differenceCols(IntegerGrid& grid)
{
  for (int i = 0; i < grid.rows; ++i)
    for (int j = grid.cols - 1; j > 0; --j)
      grid.at(i, j) = wrappingSubtract(grid.at(i, j), grid.at(i, j - 1));
}

void
sumRows(IntegerGrid& grid)
{
  for (int i = 1; i < grid.rows; ++i)
    for (int j = 0; j < grid.cols; ++j)
      grid.at(i, j) = wrappingAdd(grid.at(i, j), grid.at(i - 1, j));
}

void
sumCols(IntegerGrid& grid)
{
  for (int i = 0; i < grid.rows; ++i)
    for (int j = 1; j < grid.cols; ++j)
      grid.at(i, j) = wrappingAdd(grid.at(i, j), grid.at(i, j - 1));
}

std::uint64_t
magnitude(std::int64_t value)
{
  return value < 0 ? 0 - static_cast<std::uint64_t>(value)
                   : static_cast<std::uint64_t>(value);
}

int
bitLength(std::uint64_t value)
{
  int length = 0;
  for (; value != 0; value >>= 1)
    ++length;
  return length;
}

/** About the bits that the differences will take. */
std::uint64_t
estimatedBits(const IntegerGrid& differences)
{
  std::uint64_t bits = 0;
  for (std::int64_t value : differences.values)
    bits += 1 + 2 * static_cast<std::uint64_t>(bitLength(magnitude(value)));
  return bits;
}

/** Differences of the cheapest orders, which are stored as 3 order_u + order_v. */
IntegerGrid
bestDifferences(const IntegerGrid& grid, int& orders)
{
  IntegerGrid best;
  std::uint64_t fewest = std::numeric_limits<std::uint64_t>::max();
  IntegerGrid by_rows = grid;
  for (int u = 0; u <= kMaxOrder; ++u, differenceRows(by_rows)) {
    IntegerGrid by_both = by_rows;
    for (int v = 0; v <= kMaxOrder; ++v, differenceCols(by_both))
      if (const std::uint64_t bits = estimatedBits(by_both); bits < fewest) {
        fewest = bits;
        best = by_both;
        orders = (kMaxOrder + 1) * u + v;
      }
  }
  return best;
}

/** 0..3 for neighbours that were zero, small, medium, large. */
int
contextOf(const IntegerGrid& differences, int i, int j)
{
  const std::uint64_t above = i > 0 ? magnitude(differences.at(i - 1, j)) : 0;
  const std::uint64_t left = j > 0 ? magnitude(differences.at(i, j - 1)) : 0;
  const std::uint64_t largest = std::max(above, left);
  return largest == 0 ? 0 : largest <= 2 ? 1 : largest <= 12 ? 2 : 3;
}

} // namespace

template <class Coder>
void
IntegerGridCodec::code(Coder& coder, IntegerGrid& grid)
{
  int orders = 0;
  IntegerGrid differences;
  if constexpr (Coder::kDecodes)
    differences = grid;
  else
    differences = bestDifferences(grid, orders);
  order_.code(coder, orders);
  require(orders >= 0 && orders < (kMaxOrder + 1) * (kMaxOrder + 1),
          "unknown prediction of control values");
  for (int i = 0; i < grid.rows; ++i)
    for (int j = 0; j < grid.cols; ++j)
      (i == 0 && j == 0 ? corner_ : difference_[contextOf(differences, i, j)])
          .code(coder, differences.at(i, j));
  if constexpr (Coder::kDecodes) {
    grid = std::move(differences);
    for (int u = orders / (kMaxOrder + 1); u > 0; --u)
      sumRows(grid);
    for (int v = orders % (kMaxOrder + 1); v > 0; --v)
      sumCols(grid);
  }
}

template void
IntegerGridCodec::code(RangeEncoder&, IntegerGrid&);
template void
IntegerGridCodec::code(RangeDecoder&, IntegerGrid&);

} // namespace nurbs
} // namespace pcl
