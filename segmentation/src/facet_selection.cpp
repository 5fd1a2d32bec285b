// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "facet_selection.h"

#include <algorithm>
#include <vector>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kStripWidth = 16; // cells
constexpr std::size_t kTogether = 64;   // facets

using Cells = std::vector<std::size_t>;

/** Tries to do without single facets. */
class FacetSelection {
public:
  FacetSelection(const JoiningInput& input, const KeptEdges& edges, CellFacets& cells)
      : input_(input),
        edges_(edges),
        cells_(cells),
        size_(input.facets.count(), 0),
        members_(input.facets.count()),
        changed_(input.facets.count(), false)
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
    std::vector<std::uint32_t> order;
    for (std::uint32_t facet = 0; facet < members_.size(); ++facet)
      if (size_[facet] <= most_)
        order.push_back(facet);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return size_[a] < size_[b];
    });
    // Facets of about the same size are seldom beside each other: what threads find for
    // a few of them at a time mostly holds until it is their turn.
    const std::size_t together = input_.options.threads > 1 ? kTogether : 1;
    for (std::size_t first = 0; first < order.size(); first += together)
      dropSome({order.begin() + static_cast<std::ptrdiff_t>(first),
                order.begin() + static_cast<std::ptrdiff_t>(
                                    std::min(order.size(), first + together))});
  }

private:
  /** What becomes of a facet's cells without it. */
  struct Trial {
    bool pays = false;
    std::vector<std::uint32_t> around; // facets beside it, sorted
    std::vector<std::uint32_t> chosen; // for each of its cells
  };

  void
  dropSome(const std::vector<std::uint32_t>& candidates)
  {
    std::vector<Trial> trials(candidates.size());
    std::fill(changed_.begin(), changed_.end(), false);
#pragma omp parallel for schedule(dynamic, 1)                                          \
    num_threads(input_.options.threads) if (candidates.size() > 1)
    for (std::size_t k = 0; k < candidates.size(); ++k)
      trials[k] = tryWithout(candidates[k]);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      const std::uint32_t facet = candidates[k];
      if (size_[facet] > most_)
        continue;
      if (changed_[facet])
        trials[k] = tryWithout(facet);
      if (trials[k].pays)
        drop(facet, trials[k]);
    }
  }

  Trial
  tryWithout(std::uint32_t facet) const
  {
    Trial trial;
    const std::size_t border = lookAround(facet, trial.around);
    if (trial.around.empty())
      return trial;
    // Half of the border goes with the facet; the rest is a border still.
    const double saved =
        input_.facets.models[facet].cost +
        input_.criterion.borderSaving(0.5 * static_cast<double>(border));
    const double allowed = input_.criterion.misfitWorth(saved);
    double misfit = 0.0;
    for (const std::size_t cell : members_[facet]) {
      trial.chosen.push_back(bestAround(trial.around, cell, misfit));
      if (misfit > allowed)
        return trial;
    }
    trial.pays = true;
    return trial;
  }

  void
  drop(std::uint32_t facet, const Trial& trial)
  {
    for (std::size_t k = 0; k < trial.chosen.size(); ++k) {
      const std::uint32_t into = trial.chosen[k];
      cells_.assign(members_[facet][k], into);
      if (++size_[into] <= most_)
        members_[into].push_back(members_[facet][k]);
    }
    for (const std::uint32_t other : trial.around)
      changed_[other] = true;
    size_[facet] = 0;
    members_[facet].clear();
  }

  /** Finds the facets beside one.
   * \return number of cells at its border */
  std::size_t
  lookAround(std::uint32_t facet, std::vector<std::uint32_t>& around) const
  {
    std::size_t border = 0;
    for (const std::size_t cell : members_[facet]) {
      bool outer = false;
      edges_.forEachNeighbour(cell, [&](std::size_t next) {
        const std::uint32_t other = cells_.labels()[next];
        if (other == facet || other == CellFacets::kNone)
          return;
        outer = true;
        if (around.empty() || around.back() != other)
          around.push_back(other);
      });
      border += outer ? 1 : 0;
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    return border;
  }

  std::uint32_t
  bestAround(const std::vector<std::uint32_t>& around,
             std::size_t cell,
             double& misfit) const
  {
    std::uint32_t best = around.front();
    const ViewSample point = cells_.sample(cell);
    double least = cells_.residual(point, best);
    for (const std::uint32_t facet : around) {
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
  std::vector<bool> changed_;     // since some were tried
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
