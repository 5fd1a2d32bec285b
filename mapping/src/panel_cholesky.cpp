// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

// Code for particular processors is in functions of plain arrays; what they call is
// inlined into them.

#include "panel_cholesky.h"

#include <pcl/surface/nurbs/runtime_simd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace pcl {
namespace nurbs {
namespace {

constexpr int kLanes = 4;
constexpr int kTile = 4; // columns that are worked on at a time

using Pack = double __attribute__((vector_size(kLanes * sizeof(double))));

[[gnu::always_inline]] inline void
load(Pack& pack, const double* from)
{
  std::memcpy(&pack, from, sizeof(Pack));
}

[[gnu::always_inline]] inline void
store(double* to, const Pack& pack)
{
  std::memcpy(to, &pack, sizeof(Pack));
}

/** C -= A B^T for so many packs of rows of A and Columns rows of B. */
template <int Packs, int Columns>
[[gnu::always_inline]] inline void
subtractTile(int inner,
             const double* a,
             const double* b,
             std::ptrdiff_t stride,
             double* c,
             std::ptrdiff_t c_stride)
{
  Pack sums[Packs][Columns];
  for (int n = 0; n < Columns; ++n)
    for (int m = 0; m < Packs; ++m)
      load(sums[m][n], c + m * kLanes + n * c_stride);
  for (int k = 0; k < inner; ++k, a += stride, b += stride) {
    Pack left[Packs];
    for (int m = 0; m < Packs; ++m)
      load(left[m], a + m * kLanes);
    for (int n = 0; n < Columns; ++n)
      for (int m = 0; m < Packs; ++m)
        sums[m][n] -= left[m] * b[n];
  }
  for (int n = 0; n < Columns; ++n)
    for (int m = 0; m < Packs; ++m)
      store(c + m * kLanes + n * c_stride, sums[m][n]);
}

/** C -= A B^T for any number of rows of A and Columns rows of B. */
template <int Columns>
[[gnu::always_inline]] inline void
subtractColumns(int rows,
                int inner,
                const double* a,
                const double* b,
                std::ptrdiff_t stride,
                double* c,
                std::ptrdiff_t c_stride)
{
  int row = 0;
  for (; row + 2 * kLanes <= rows; row += 2 * kLanes)
    subtractTile<2, Columns>(inner, a + row, b, stride, c + row, c_stride);
  for (; row + kLanes <= rows; row += kLanes)
    subtractTile<1, Columns>(inner, a + row, b, stride, c + row, c_stride);
  for (; row < rows; ++row)
    for (int n = 0; n < Columns; ++n) {
      double sum = c[row + n * c_stride];
      for (int k = 0; k < inner; ++k)
        sum -= a[row + k * stride] * b[n + k * stride];
      c[row + n * c_stride] = sum;
    }
}

[[gnu::always_inline]] inline void
subtractSomeColumns(int columns,
                    int rows,
                    int inner,
                    const double* a,
                    const double* b,
                    std::ptrdiff_t stride,
                    double* c,
                    std::ptrdiff_t c_stride)
{
  switch (columns) {
  case 1:
    return subtractColumns<1>(rows, inner, a, b, stride, c, c_stride);
  case 2:
    return subtractColumns<2>(rows, inner, a, b, stride, c, c_stride);
  case 3:
    return subtractColumns<3>(rows, inner, a, b, stride, c, c_stride);
  default:
    return subtractColumns<kTile>(rows, inner, a, b, stride, c, c_stride);
  }
}

/** Factor one column whose earlier ones have been subtracted up to its tile.
 * \return false if its pivot is refused */
[[gnu::always_inline]] inline bool
factorColumn(double* panel, int rows, int column, int tile_begin, double bound)
{
  double* const own = panel + static_cast<std::ptrdiff_t>(column) * rows;
  for (int k = tile_begin; k < column; ++k) {
    const double* const earlier = panel + static_cast<std::ptrdiff_t>(k) * rows;
    const double factor = earlier[column];
    for (int row = column; row < rows; ++row)
      own[row] -= factor * earlier[row];
  }
  const double pivot = own[column];
  if (!(pivot > std::max(bound, 0.0)) || !std::isfinite(pivot))
    return false;
  const double inverse = 1.0 / std::sqrt(pivot);
  for (int row = column; row < rows; ++row)
    own[row] *= inverse;
  return true;
}

} // namespace

PCL_NURBS_RUNTIME_SIMD bool
factorPanel(double* panel, int rows, int columns, double least)
{
  for (int begin = 0; begin < columns; begin += kTile) {
    const int width = std::min(kTile, columns - begin);
    double bounds[kTile];
    double* const tile = panel + static_cast<std::ptrdiff_t>(begin) * rows + begin;
    for (int n = 0; n < width; ++n)
      bounds[n] = least * tile[n + static_cast<std::ptrdiff_t>(n) * rows];
    subtractSomeColumns(
        width, rows - begin, begin, panel + begin, panel + begin, rows, tile, rows);
    for (int n = 0; n < width; ++n)
      if (!factorColumn(panel, rows, begin + n, begin, bounds[n]))
        return false;
  }
  return true;
}

PCL_NURBS_RUNTIME_SIMD void
subtractPanel(
    const double* panel, int rows, int columns, double* rest, int rest_columns)
{
  const int rest_rows = rows - columns;
  const double* const below = panel + columns;
  for (int begin = 0; begin < rest_columns; begin += kTile)
    subtractSomeColumns(std::min(kTile, rest_columns - begin),
                        rest_rows - begin,
                        columns,
                        below + begin,
                        below + begin,
                        rows,
                        rest + static_cast<std::ptrdiff_t>(begin) * rest_rows + begin,
                        rest_rows);
}

} // namespace nurbs
} // namespace pcl
