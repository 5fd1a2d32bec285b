// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "facet_selection.h"

#include <algorithm>
#include <numeric>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kStripWidth = 16; // cells

using Cells = std::vector<std::size_t>;

/** Tries to do without single facets. */
class FacetSelection {
public:
  FacetSelection(const JoiningInput& input, const KeptEdges& edges, CellFacets& cells)
      : input_(input),
        edges_(edges),
        cells_(cells),
        size_(input.facets.count(), 0),
        members_(input.facets.count())
  {
    for (const std::uint32_t facet : cells.labels())
      if (facet != CellFacets::kNone)
        ++size_[facet];
    // Strips along a fold are long, but as narrow as the blocks.
    const GridGeometry& grid = input_.points.geometry;
    most_ = kStripWidth * static_cast<std::size_t>(grid.width + grid.height);
    for (std::size_t cell = 0; cell < input.points.size(); ++cell) {
      const std::uint32_t facet = cells.labels()[cell];
      if (facet != CellFacets::kNone && size_[facet] <= most_)
        members_[facet].push_back(cell);
    }
  }

  void
  run()
  {
    std::vector<std::uint32_t> order(members_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return size_[a] < size_[b];
    });
    for (const std::uint32_t facet : order)
      if (size_[facet] <= most_)
        tryWithout(facet);
  }

private:
  void
  tryWithout(std::uint32_t facet)
  {
    const std::size_t border = lookAround(facet);
    if (around_.empty())
      return;
    // Half of the border goes with the facet; the rest is a border still.
    const double saved =
        input_.facets.models[facet].cost +
        input_.criterion.borderSaving(0.5 * static_cast<double>(border));
    const double allowed = input_.criterion.misfitWorth(saved);
    std::vector<std::uint32_t> chosen;
    double misfit = 0.0;
    for (const std::size_t cell : members_[facet]) {
      chosen.push_back(bestAround(cell, misfit));
      if (misfit > allowed)
        return;
    }
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      cells_.assign(members_[facet][k], chosen[k]);
      if (++size_[chosen[k]] <= most_)
        members_[chosen[k]].push_back(members_[facet][k]);
    }
    size_[facet] = 0;
    members_[facet].clear();
  }

  /** Finds the facets beside one.
   * \return number of cells at its border */
  std::size_t
  lookAround(std::uint32_t facet)
  {
    around_.clear();
    std::size_t border = 0;
    for (const std::size_t cell : members_[facet]) {
      bool outer = false;
      edges_.forEachNeighbour(cell, [&](std::size_t next) {
        const std::uint32_t other = cells_.labels()[next];
        if (other == facet || other == CellFacets::kNone)
          return;
        outer = true;
        if (around_.empty() || around_.back() != other)
          around_.push_back(other);
      });
      border += outer ? 1 : 0;
    }
    std::sort(around_.begin(), around_.end());
    around_.erase(std::unique(around_.begin(), around_.end()), around_.end());
    return border;
  }

  std::uint32_t
  bestAround(std::size_t cell, double& misfit) const
  {
    std::uint32_t best = around_.front();
    const ViewSample point = cells_.sample(cell);
    double least = cells_.residual(point, best);
    for (const std::uint32_t facet : around_) {
      const double square = cells_.residual(point, facet);
      if (square < least) {
        least = square;
        best = facet;
      }
    }
    misfit += least;
    return best;
  }

  const JoiningInput& input_;
  const KeptEdges& edges_;
  CellFacets& cells_;
  std::size_t most_ = 0;          // cells of a facet that may be dropped
  std::vector<std::size_t> size_; // cells of each facet
  std::vector<Cells> members_;    // of those that may be dropped
  std::vector<std::uint32_t> around_;
};

} // namespace

void
dropRedundantFacets(const JoiningInput& input,
                    const KeptEdges& edges,
                    CellFacets& cells)
{
  FacetSelection(input, edges, cells).run();
}

} // namespace nurbs
} // namespace pcl
