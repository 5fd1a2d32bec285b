// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "border_fits.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Fewer points say nothing about a surface near a border. */
constexpr double kLeastPoints = 12.0;
/** Points of every second row and column are enough. */
constexpr int kStride = 2;

} // namespace

void
BorderPieces::add(std::uint32_t p, std::uint32_t q, std::size_t cell)
{
  const std::size_t block =
      cell / width_ / static_cast<std::size_t>(size_.rows) * width_ +
      cell % width_ / static_cast<std::size_t>(size_.columns);
  const auto [a, b] = std::minmax(p, q);
  BorderPiece& piece = pieces_[{a, b, block}];
  if (++piece.cells % 2 == 1)
    piece.middle = cell;
}

BorderPieces
keptBorders(const GridGeometry& grid,
            const KeptEdges& edges,
            const std::vector<std::uint32_t>& cell_facet,
            std::uint32_t facets,
            BlockSize size)
{
  BorderPieces borders(grid, size);
  const GridGraph& graph = edges.graph();
  for (int d = 0; d < 2; ++d) // rows and columns
    for (std::size_t i = 0; i < cell_facet.size(); ++i) {
      if (cell_facet[i] >= facets || !edges.keeps(d, i))
        continue;
      const std::uint32_t other =
          cell_facet[static_cast<std::size_t>(graph.target(d)[i])];
      if (other < facets && other != cell_facet[i])
        borders.add(cell_facet[i], other, i);
    }
  return borders;
}

std::optional<BorderFit>
BorderFitter::at(std::uint32_t a, std::uint32_t b, std::size_t cell) const
{
  const std::array<ViewSums, 2> sums = around(a, b, cell);
  if (sums[0].count() < kLeastPoints || sums[1].count() < kLeastPoints)
    return std::nullopt;
  const int most = chart_.termChoices()[1];
  const Eigen::Vector3d where = chart_.direction(cell);
  const std::array<double, kMostViewTerms> basis = chart_.basis(where);
  BorderFit fit;
  std::array<double, 2> value{};
  for (std::size_t side = 0; side < 2; ++side) {
    const ViewPolynomial surface = criterion_.best(sums[side], most).surface;
    value[side] = surface(basis);
    fit.normal[side] = chart_.normal(surface, where);
    fit.middle[side] = chart_.position(surface, sums[side].meanDirection());
  }
  ViewSums both = sums[0];
  both += sums[1];
  const int plane = chart_.termChoices()[0];
  fit.bends = both.misfit(both.fit(most)) <
              sums[0].misfit(sums[0].fit(plane)) + sums[1].misfit(sums[1].fit(plane));
  fit.step = std::abs(value[0] - value[1]) / chart_.sigma(cell);
  return fit;
}

std::array<ViewSums, 2>
BorderFitter::around(std::uint32_t a, std::uint32_t b, std::size_t cell) const
{
  const GridGeometry& grid = points_.geometry;
  const int row = static_cast<int>(cell) / grid.width;
  const int column = static_cast<int>(cell) % grid.width;
  const int far_rows = 2 * size_.rows;
  const int far_columns = 2 * size_.columns;
  std::array<ViewSums, 2> sums;
  for (int r = std::max(0, row - far_rows);
       r <= std::min(grid.height - 1, row + far_rows);
       r += kStride)
    for (int k = column - far_columns; k <= column + far_columns; k += kStride) {
      const int c = grid.wrap ? (k + grid.width) % grid.width : k;
      if (c < 0 || c >= grid.width)
        continue;
      const auto at = static_cast<std::size_t>(r * grid.width + c);
      if (cell_set_[at] == a || cell_set_[at] == b)
        sums[cell_set_[at] == a ? 0 : 1].add(chart_.sample(at));
    }
  return sums;
}

} // namespace nurbs
} // namespace pcl
