// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "surface_joining.h"

#include <algorithm>
#include <limits>

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
  const auto width = static_cast<std::size_t>(input.points.geometry.width);
  const std::vector<std::uint32_t>& node = input.nodes.ofCell();
  for (std::size_t cell = 0; cell < node.size(); ++cell) {
    if (node[cell] == SurfaceNodes::kNone)
      continue;
    CellBox& box = boxes[input.facets.of_node[node[cell]]];
    const int column = static_cast<int>(cell % width);
    const int row = static_cast<int>(cell / width);
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

bool
oneSurface(const JoiningInput& input, std::uint32_t a, std::uint32_t b)
{
  const SurfaceFacets& facets = input.facets;
  double saving = 0.0;
  return input.criterion
      .merged(facets.sums[a],
              facets.models[a],
              facets.sums[b],
              facets.models[b],
              0.0,
              saving)
      .has_value();
}

} // namespace

void
joinSeparated(const JoiningInput& input, DisjointSets& surfaces)
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
  for (std::size_t i = 0; i < large.size(); ++i)
    for (std::size_t j = i + 1; j < large.size(); ++j) {
      const CellBox& a = boxes[large[i]];
      const CellBox& b = boxes[large[j]];
      if (surfaces.find(large[i]) != surfaces.find(large[j]) &&
          gapBetween(input.points.geometry, a, b) <= std::min(a.extent(), b.extent()) &&
          oneSurface(input, large[i], large[j]))
        surfaces.join(large[i], large[j]);
    }
}

} // namespace nurbs
} // namespace pcl
