// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "border_agglomeration.h"
#include "surface_joining.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Largest step (standard deviations) between the local fits of one surface. */
constexpr double kStepSigmas = 3.0;
/** Share of the common border that must be smooth. */
constexpr double kSmoothShare = 0.6;
/** Fewer points say nothing about a surface near a border. */
constexpr double kLeastPoints = 12.0;
/** Points of every second row and column are enough. */
constexpr int kStride = 2;

/** A piece of the border between two facets, in one block. */
struct BorderPiece {
  std::size_t cells = 0;
  std::size_t middle = 0; /**< one of its cells */
};

/** Two facets, a < b, and the block their border passes. */
struct BorderKey {
  std::uint32_t a;
  std::uint32_t b;
  std::size_t block;

  bool
  operator<(const BorderKey& other) const
  {
    return std::tie(a, b, block) < std::tie(other.a, other.b, other.block);
  }
};

using Borders = std::map<BorderKey, BorderPiece>;

Borders
bordersOf(const GridGeometry& grid,
          const KeptEdges& edges,
          const std::vector<std::uint32_t>& cell_facet,
          std::uint32_t facets,
          BlockSize size)
{
  Borders borders;
  const auto width = static_cast<std::size_t>(grid.width);
  const GridGraph& graph = edges.graph();
  for (int d = 0; d < 2; ++d) // rows and columns
    for (std::size_t i = 0; i < cell_facet.size(); ++i) {
      if (cell_facet[i] >= facets || !edges.keeps(d, i))
        continue;
      const std::uint32_t other =
          cell_facet[static_cast<std::size_t>(graph.target(d)[i])];
      if (other >= facets || other == cell_facet[i])
        continue;
      const std::size_t block =
          i / width / static_cast<std::size_t>(size.rows) * width +
          i % width / static_cast<std::size_t>(size.columns);
      const auto [a, b] = std::minmax(cell_facet[i], other);
      BorderPiece& piece = borders[{a, b, block}];
      if (++piece.cells % 2 == 1)
        piece.middle = i;
    }
  return borders;
}

/** Compares two facets at places of their border. */
class BorderTest {
public:
  BorderTest(const JoiningInput& input,
             const std::vector<std::uint32_t>& cell_facet,
             BlockSize size)
      : input_(input), cell_facet_(cell_facet), size_(size)
  {
  }

  bool
  smooth(std::uint32_t a, std::uint32_t b, std::size_t cell) const
  {
    const std::array<ViewSums, 2> sums = around(a, b, cell);
    if (sums[0].count() < kLeastPoints || sums[1].count() < kLeastPoints)
      return false;
    const ViewChart& chart = input_.chart;
    const int most = chart.termChoices()[1];
    const ViewPolynomial fit_a = input_.criterion.best(sums[0], most).surface;
    const ViewPolynomial fit_b = input_.criterion.best(sums[1], most).surface;
    const Eigen::Vector3d where = chart.direction(cell);
    const std::array<double, kMostViewTerms> basis = chart.basis(where);
    const double step = std::abs(fit_a(basis) - fit_b(basis));
    const double cosine = chart.normal(fit_a, where).dot(chart.normal(fit_b, where));
    return step <= kStepSigmas * chart.sigma(cell) &&
           cosine >= std::cos(input_.options.crease_angle);
  }

private:
  /** Sums over the points of two facets near a cell. */
  std::array<ViewSums, 2>
  around(std::uint32_t a, std::uint32_t b, std::size_t cell) const
  {
    const GridGeometry& grid = input_.points.geometry;
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
        if (cell_facet_[at] == a || cell_facet_[at] == b)
          sums[cell_facet_[at] == a ? 0 : 1].add(input_.chart.sample(at));
      }
    return sums;
  }

  const JoiningInput& input_;
  const std::vector<std::uint32_t>& cell_facet_;
  BlockSize size_;
};

} // namespace

void
joinSmooth(const JoiningInput& input,
           const KeptEdges& edges,
           const std::vector<std::uint32_t>& cell_facet,
           BlockSize size,
           DisjointSets& surfaces)
{
  const Borders borders =
      bordersOf(input.points.geometry, edges, cell_facet, input.facets.count(), size);
  const BorderTest test(input, cell_facet, size);
  const std::vector<std::pair<BorderKey, BorderPiece>> pieces(borders.begin(),
                                                              borders.end());
  std::vector<std::uint8_t> smooth(pieces.size());
#pragma omp parallel for schedule(dynamic, 16) num_threads(input.options.threads)
  for (std::size_t k = 0; k < pieces.size(); ++k)
    smooth[k] =
        test.smooth(pieces[k].first.a, pieces[k].first.b, pieces[k].second.middle);
  BorderAgglomeration agglomeration(input.facets.count());
  for (std::size_t k = 0; k < pieces.size(); ++k)
    agglomeration.add(
        pieces[k].first.a, pieces[k].first.b, pieces[k].second.cells, smooth[k] != 0);
  agglomeration.joinInto(surfaces, kSmoothShare);
}

} // namespace nurbs
} // namespace pcl
