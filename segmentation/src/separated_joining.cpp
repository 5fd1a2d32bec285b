// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "surface_joining.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <optional>

namespace pcl {
namespace nurbs {
namespace {

/** Smaller facets say too little about where their surface goes on (points). */
constexpr double kLeastPoints = 200.0;
/** So many of the largest facets are compared with each other. */
constexpr std::size_t kMostFacets = 400;

/** Columns and rows a facet lies in. */
struct CellBox {
  int left = std::numeric_limits<int>::max();
  int right = -1;
  int top = std::numeric_limits<int>::max();
  int bottom = -1;

  int
  extent() const
  {
    return std::max(right - left, bottom - top) + 1;
  }
};

std::vector<CellBox>
boxesOf(const JoiningInput& input)
{
  std::vector<CellBox> boxes(input.facets.count());
  const int width = input.points.geometry.width;
  const std::vector<std::uint32_t>& node = input.nodes.ofCell();
  for (std::size_t cell = 0; cell < node.size(); ++cell) {
    if (node[cell] == SurfaceNodes::kNone)
      continue;
    CellBox& box = boxes[input.facets.of_node[node[cell]]];
    const int column = static_cast<int>(cell) % width;
    const int row = static_cast<int>(cell) / width;
    box.left = std::min(box.left, column);
    box.right = std::max(box.right, column);
    box.top = std::min(box.top, row);
    box.bottom = std::max(box.bottom, row);
  }
  return boxes;
}

/** Cells between two boxes; not positive where they overlap. */
int
gapBetween(const GridGeometry& grid, const CellBox& a, const CellBox& b)
{
  int across = std::max(a.left - b.right, b.left - a.right);
  if (grid.wrap)
    across = std::min(
        across, grid.width - std::max(a.right, b.right) + std::min(a.left, b.left));
  return std::max(across, std::max(a.top - b.bottom, b.top - a.bottom));
}

/** The model of two facets together, if it explains both. */
std::optional<CostedModel>
commonModel(const JoiningInput& input, std::uint32_t a, std::uint32_t b)
{
  const SurfaceFacets& facets = input.facets;
  double saving = 0.0;
  return input.criterion.merged(
      facets.sums[a], facets.models[a], facets.sums[b], facets.models[b], 0.0, saving);
}

/** Looks at what lies between parts of a surface. */
class GapEvidence {
public:
  GapEvidence(const JoiningInput& input, const FacetCells& cells)
      : input_(input), cells_(cells), members_(cells.count)
  {
    for (std::size_t cell = 0; cell < cells.facet.size(); ++cell)
      if (cells.facet[cell] < cells.count)
        members_[cells.facet[cell]].push_back(cell);
  }

  /** Whether rays between two facets mostly went through a surface that would join
   * them: what they met lies behind it. An occluder or no reading says nothing. */
  bool
  contradicts(std::uint32_t a, std::uint32_t b, const ViewPolynomial& surface) const
  {
    Count count;
    for (const std::size_t p : some(members_[a]))
      for (const std::size_t q : some(members_[b]))
        look(p, q, surface, count);
    return 2 * count.behind > count.all;
  }

private:
  struct Count {
    std::size_t behind = 0;
    std::size_t all = 0;
  };

  static std::vector<std::size_t>
  some(const std::vector<std::size_t>& cells)
  {
    constexpr std::size_t kSample = 12;
    std::vector<std::size_t> chosen;
    for (std::size_t k = 0; k < kSample && !cells.empty(); ++k)
      chosen.push_back(cells[(2 * k + 1) * cells.size() / (2 * kSample)]);
    return chosen;
  }

  /** Counts the cells on the line between two that belong to neither's facet. */
  void
  look(std::size_t p, std::size_t q, const ViewPolynomial& surface, Count& count) const
  {
    const int width = input_.points.geometry.width;
    const auto row = [&](std::size_t cell) { return static_cast<int>(cell) / width; };
    const auto column = [&](std::size_t cell) {
      return static_cast<int>(cell) % width;
    };
    int across = column(q) - column(p);
    if (input_.points.geometry.wrap && 2 * std::abs(across) > width)
      across += across > 0 ? -width : width;
    const int down = row(q) - row(p);
    const int steps = std::max(std::abs(across), std::abs(down));
    for (int k = 1; k < steps; ++k) {
      const int c = column(p) + across * k / steps;
      const int r = row(p) + down * k / steps;
      const auto cell = static_cast<std::size_t>(r * width + (c + width) % width);
      const std::uint32_t facet = cells_.facet[cell];
      if (facet == cells_.facet[p] || facet == cells_.facet[q])
        continue;
      ++count.all;
      count.behind += isBehind(cell, surface) ? 1 : 0;
    }
  }

  /** Both inverse depths and heights grow towards the sensor. */
  bool
  isBehind(std::size_t cell, const ViewPolynomial& surface) const
  {
    if (!input_.points.valid(cell))
      return false;
    const ViewSample sample = input_.chart.sample(cell);
    const double off = surface(sample.basis) - sample.value;
    return off > 0.0 && off * off * sample.weight >
                            input_.options.point_sigmas * input_.options.point_sigmas;
  }

  const JoiningInput& input_;
  const FacetCells& cells_;
  std::vector<std::vector<std::size_t>> members_;
};

} // namespace

void
joinSeparated(const JoiningInput& input,
              const FacetCells& cells,
              DisjointSets& surfaces)
{
  const SurfaceFacets& facets = input.facets;
  const std::vector<CellBox> boxes = boxesOf(input);
  std::vector<std::uint32_t> large;
  for (std::uint32_t facet = 0; facet < facets.count(); ++facet)
    if (facets.sums[facet].count() >= kLeastPoints)
      large.push_back(facet);
  std::stable_sort(large.begin(), large.end(), [&](std::uint32_t a, std::uint32_t b) {
    return facets.sums[a].count() > facets.sums[b].count();
  });
  large.resize(std::min(large.size(), kMostFacets));
  const GapEvidence evidence(input, cells);
  for (std::size_t i = 0; i < large.size(); ++i)
    for (std::size_t j = i + 1; j < large.size(); ++j) {
      const CellBox& a = boxes[large[i]];
      const CellBox& b = boxes[large[j]];
      if (surfaces.find(large[i]) == surfaces.find(large[j]) ||
          gapBetween(input.points.geometry, a, b) > std::min(a.extent(), b.extent()))
        continue;
      const std::optional<CostedModel> model = commonModel(input, large[i], large[j]);
      if (model && !evidence.contradicts(large[i], large[j], model->surface))
        surfaces.join(large[i], large[j]);
    }
}

} // namespace nurbs
} // namespace pcl
