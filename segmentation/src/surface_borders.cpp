// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "surface_borders.h"

#include <algorithm>
#include <array>
#include <limits>

namespace pcl {
namespace nurbs {
namespace {

/** How often borders move on, by a cell or more. */
constexpr int kSweeps = 16;
/** What a neighbour of another facet costs, in units of a squared residual. */
constexpr double kNeighbourCost = 1.0;
/** Residuals beyond this many standard deviations say no more than this. */
constexpr double kMostSigmas = 6.0;
constexpr std::size_t kMostNeighbours = 8;
/** Cells that are worth a second thread. */
constexpr std::size_t kMany = 1024;

std::vector<std::size_t>
cellsOf(const std::vector<std::uint8_t>& flags)
{
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < flags.size(); ++cell)
    if (flags[cell] != 0)
      cells.push_back(cell);
  return cells;
}

} // namespace

CellFacets::CellFacets(const JoiningInput& input, const KeptEdges& edges)
    : input_(input), edges_(edges), facet_(input.points.size(), kNone)
{
  const std::vector<std::uint32_t>& node = input.nodes.ofCell();
  for (std::size_t cell = 0; cell < node.size(); ++cell)
    if (node[cell] != SurfaceNodes::kNone)
      facet_[cell] = input.facets.of_node[node[cell]];
}

double
CellFacets::residual(const ViewSample& sample, std::uint32_t facet) const
{
  if (facet >= input_.facets.count())
    return kMostSigmas * kMostSigmas; // without a model
  const double off = sample.value - input_.facets.models[facet].surface(sample.basis);
  return std::min(off * off * sample.weight, kMostSigmas * kMostSigmas);
}

std::uint32_t
CellFacets::bestNeighbour(std::size_t cell, double sigmas) const
{
  std::uint32_t best = kNone;
  double least = sigmas * sigmas;
  const ViewSample point = sample(cell);
  edges_.forEachNeighbour(cell, [&](std::size_t neighbour) {
    const std::uint32_t facet = facet_[neighbour];
    if (facet == kNone || facet == best)
      return;
    const double square = residual(point, facet);
    if (square < least || (square == least && facet < best)) {
      least = square;
      best = facet;
    }
  });
  return best;
}

std::vector<std::size_t>
CellFacets::besideFacets() const
{
  std::vector<std::uint8_t> beside(facet_.size(), 0);
#pragma omp parallel for num_threads(input_.options.threads)
  for (std::size_t cell = 0; cell < facet_.size(); ++cell)
    if (facet_[cell] == kNone)
      edges_.forEachNeighbour(cell, [&](std::size_t next) {
        if (facet_[next] != kNone)
          beside[cell] = 1;
      });
  return cellsOf(beside);
}

void
CellFacets::grow(double sigmas)
{
  std::vector<std::uint8_t> waiting(facet_.size(), 0);
  std::vector<std::size_t> front = besideFacets();
  while (!front.empty()) {
    // A ring at a time, so that no facet is ahead of the others.
    std::vector<std::uint32_t> chosen(front.size());
#pragma omp parallel for num_threads(input_.options.threads) if (front.size() > kMany)
    for (std::size_t k = 0; k < front.size(); ++k)
      chosen[k] = bestNeighbour(front[k], sigmas);
    for (std::size_t k = 0; k < front.size(); ++k)
      facet_[front[k]] = chosen[k];
    std::vector<std::size_t> next;
    for (std::size_t k = 0; k < front.size(); ++k)
      if (chosen[k] != kNone)
        edges_.forEachNeighbour(front[k], [&](std::size_t cell) {
          if (facet_[cell] != kNone || waiting[cell] != 0)
            return;
          waiting[cell] = 1;
          next.push_back(cell);
        });
    for (const std::size_t cell : next)
      waiting[cell] = 0;
    front.swap(next);
  }
}

void
CellFacets::spread(std::size_t cell,
                   std::uint32_t facet,
                   std::vector<std::size_t>& cells)
{
  cells.assign(1, cell);
  facet_[cell] = facet;
  for (std::size_t k = 0; k < cells.size(); ++k)
    edges_.forEachNeighbour(cells[k], [&](std::size_t next) {
      if (facet_[next] == kNone) {
        facet_[next] = facet;
        cells.push_back(next);
      }
    });
}

bool
CellFacets::isLine(const std::vector<std::size_t>& cells) const
{
  constexpr std::size_t kInnerShare = 10; // one in so many
  const std::uint32_t facet = facet_[cells.front()];
  const auto most = static_cast<std::size_t>(2 * edges_.graph().numDirections());
  std::size_t inner = 0;
  for (const std::size_t cell : cells) {
    const std::size_t degree = edges_.graph().degree(cell);
    std::size_t same = 0;
    edges_.forEachNeighbour(
        cell, [&](std::size_t next) { same += facet_[next] == facet ? 1 : 0; });
    inner += 4 * degree >= 3 * most && 4 * same >= 3 * degree ? 1 : 0;
  }
  return kInnerShare * inner < cells.size();
}

std::uint32_t
CellFacets::addLeftOver(std::uint32_t first)
{
  std::vector<std::size_t> lines;
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < facet_.size(); ++cell) {
    if (facet_[cell] != kNone || !input_.points.valid(cell))
      continue;
    spread(cell, first, cells);
    if (isLine(cells))
      lines.insert(lines.end(), cells.begin(), cells.end());
    else
      ++first;
  }
  for (const std::size_t cell : lines)
    facet_[cell] = kNone;
  return first;
}

std::vector<std::size_t>
CellFacets::atBorders() const
{
  std::vector<std::uint8_t> border(facet_.size(), 0);
#pragma omp parallel for num_threads(input_.options.threads)
  for (std::size_t cell = 0; cell < facet_.size(); ++cell)
    if (facet_[cell] != kNone)
      edges_.forEachNeighbour(cell, [&](std::size_t next) {
        if (facet_[next] != kNone && facet_[next] != facet_[cell])
          border[cell] = 1;
      });
  return cellsOf(border);
}

std::uint32_t
CellFacets::cheapest(std::size_t cell) const
{
  std::array<std::uint32_t, kMostNeighbours> around;
  std::size_t count = 0;
  edges_.forEachNeighbour(cell,
                          [&](std::size_t next) { around[count++] = facet_[next]; });
  std::uint32_t best = facet_[cell];
  double least = std::numeric_limits<double>::infinity();
  const ViewSample point = sample(cell);
  const auto consider = [&](std::uint32_t facet) {
    double cost = residual(point, facet);
    for (std::size_t k = 0; k < count; ++k)
      cost += around[k] == facet ? 0.0 : kNeighbourCost;
    if (cost < least) {
      least = cost;
      best = facet;
    }
  };
  consider(facet_[cell]);
  for (std::size_t k = 0; k < count; ++k)
    if (around[k] != kNone && around[k] != facet_[cell] && around[k] != best)
      consider(around[k]);
  return best;
}

void
CellFacets::refine()
{
  std::vector<std::size_t> front = atBorders();
  std::vector<std::uint8_t> waiting(facet_.size(), 0);
  std::vector<std::uint8_t> changed(facet_.size(), 0); // a neighbour, in this sweep
  for (int sweep = 0; sweep < kSweeps && !front.empty(); ++sweep) {
    // Most cells stay as they are: what threads find for all of them is right but where
    // a cell before has changed.
    std::vector<std::uint32_t> best(front.size());
#pragma omp parallel for num_threads(input_.options.threads) if (front.size() > kMany)
    for (std::size_t k = 0; k < front.size(); ++k)
      best[k] = cheapest(front[k]);
    std::vector<std::size_t> next;
    for (std::size_t k = 0; k < front.size(); ++k) {
      const std::size_t cell = front[k];
      waiting[cell] = 0;
      if (changed[cell] != 0)
        best[k] = cheapest(cell);
      changed[cell] = 0;
      if (best[k] == facet_[cell])
        continue;
      facet_[cell] = best[k];
      edges_.forEachNeighbour(cell, [&](std::size_t other) {
        changed[other] = 1;
        if (waiting[other] == 0 && facet_[other] != kNone) {
          waiting[other] = 1;
          next.push_back(other);
        }
      });
    }
    std::fill(changed.begin(), changed.end(), std::uint8_t{0});
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    front.swap(next);
  }
}

} // namespace nurbs
} // namespace pcl
