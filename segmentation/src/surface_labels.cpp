// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "surface_labels.h"

#include "surface_borders.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** Label of each facet's surface. */
struct Numbering {
  std::vector<std::uint32_t> label;
  std::uint32_t count = 0;
};

Numbering
numberBySize(const std::vector<std::uint32_t>& cell_facet,
             std::size_t min_size,
             DisjointSets& surfaces)
{
  std::vector<std::size_t> sizes(surfaces.size(), 0);
  for (const std::uint32_t facet : cell_facet)
    if (facet != CellFacets::kNone)
      ++sizes[surfaces.find(facet)];
  std::vector<std::uint32_t> order;
  for (std::uint32_t root = 0; root < sizes.size(); ++root)
    if (sizes[root] >= std::max<std::size_t>(min_size, 1))
      order.push_back(root);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return sizes[a] > sizes[b];
  });
  std::vector<std::uint32_t> of_root(surfaces.size(), 0);
  Numbering numbering;
  for (const std::uint32_t root : order)
    of_root[root] = ++numbering.count;
  numbering.label.resize(surfaces.size());
  for (std::uint32_t facet = 0; facet < numbering.label.size(); ++facet)
    numbering.label[facet] = of_root[surfaces.find(facet)];
  return numbering;
}

void
addModels(const JoiningInput& input,
          const Numbering& numbering,
          std::vector<SurfaceGroup>& groups)
{
  std::vector<std::uint32_t> order(input.facets.count());
  for (std::uint32_t facet = 0; facet < order.size(); ++facet)
    order[facet] = facet;
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return input.facets.sums[a].count() > input.facets.sums[b].count();
  });
  std::vector<double> squares(groups.size(), 0.0);
  std::vector<double> counts(groups.size(), 0.0);
  for (const std::uint32_t facet : order)
    if (numbering.label[facet] != 0) {
      const std::uint32_t group = numbering.label[facet] - 1;
      groups[group].models.push_back(input.facets.models[facet].surface);
      squares[group] += input.facets.models[facet].misfit;
      counts[group] += input.facets.sums[facet].count();
    }
  for (std::size_t k = 0; k < groups.size(); ++k)
    groups[k].rms = counts[k] > 0.0 ? std::sqrt(squares[k] / counts[k]) : 0.0;
}

} // namespace

std::uint32_t
labelSurfaces(const JoiningInput& input,
              const std::vector<std::uint32_t>& cell_facet,
              DisjointSets& surfaces,
              std::vector<std::uint32_t>& labels,
              std::vector<SurfaceGroup>* groups)
{
  const Numbering numbering =
      numberBySize(cell_facet, input.options.min_size, surfaces);
  labels.assign(cell_facet.size(), 0);
  for (std::size_t cell = 0; cell < labels.size(); ++cell)
    if (cell_facet[cell] != CellFacets::kNone)
      labels[cell] = numbering.label[cell_facet[cell]];
  if (groups == nullptr)
    return numbering.count;
  groups->assign(numbering.count, {});
  for (const std::uint32_t label : labels)
    if (label != 0)
      ++(*groups)[label - 1].size;
  addModels(input, numbering, *groups);
  return numbering.count;
}

} // namespace nurbs
} // namespace pcl
