// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/surface_grouping.h>

#include "facet_selection.h"
#include "noise_dispersion.h"
#include "surface_borders.h"
#include "surface_labels.h"
#include "surface_merging.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <cstdlib>
#include <cstdio>

#include <chrono>
static std::chrono::steady_clock::time_point t0;
#define TICK(x) if (getenv("DBG")) { auto t=std::chrono::steady_clock::now(); printf("%6.1f %s\n", 1e3*std::chrono::duration<double>(t-t0).count(), x); t0=t; }
namespace pcl {
namespace nurbs {
namespace {

void
requireValid(const GridPoints& points,
             const GridGraph& graph,
             const SurfaceGroupingOptions& options)
{
  if (graph.numCells() != points.size())
    throw std::invalid_argument("groupSurfaces: the graph is not of these points");
  if (!(options.points_per_sample == 0.0 || options.points_per_sample >= 1.0))
    throw std::invalid_argument("groupSurfaces: a sample has at least one point");
  if (!(options.coefficient_cost >= 0.0) || !(options.patch_cost >= 0.0) ||
      !(options.border_cost >= 0.0))
    throw std::invalid_argument("groupSurfaces: costs must not be negative");
  if (!(options.fit_sigmas > 0.0) || !(options.point_sigmas > 0.0) ||
      !(options.min_weight > 0.0F) || !(options.jump_sigmas > 0.0F) ||
      !(options.crease_angle > 0.0))
    throw std::invalid_argument("groupSurfaces: thresholds must be positive");
  if (options.threads < 1)
    throw std::invalid_argument("groupSurfaces: there must be a thread");
}

/** Blocks, coarse to fine, about as wide as high on a surface that faces the sensor. */
std::vector<BlockSize>
blockSizes(const GridGeometry& grid)
{
  constexpr int kFine = 4;
  constexpr double kMostStretch = 4.0;
  const double across = grid.columnSpacing(1.0);
  const double down = grid.rowSpacing(1.0);
  double stretch = across > 0.0 && down > 0.0 ? down / across : 1.0;
  stretch = std::clamp(stretch, 1.0 / kMostStretch, kMostStretch);
  const int columns = kFine * std::max(1, static_cast<int>(std::lround(stretch)));
  const int rows = kFine * std::max(1, static_cast<int>(std::lround(1.0 / stretch)));
  constexpr int kManyRows = 160; // fewer are too few for coarse blocks
  if (grid.height < kManyRows)
    return {{columns, rows}};
  return {{2 * columns, 2 * rows}, {columns, rows}};
}

ConnectedGroupsOptions
edgeOptions(const SurfaceGroupingOptions& options)
{
  ConnectedGroupsOptions result;
  result.min_weight = options.min_weight;
  result.jump_sigmas = options.jump_sigmas;
  result.threads = options.threads;
  return result;
}

SurfaceFacets
facetsOf(SurfaceMerging& merging, std::uint32_t nodes)
{
  SurfaceFacets facets;
  facets.of_node.resize(nodes);
  for (std::uint32_t node = 0; node < nodes; ++node) {
    const std::uint32_t root = merging.find(node); // never behind its members
    if (root != node) {
      facets.of_node[node] = facets.of_node[root];
      continue;
    }
    facets.of_node[node] = facets.count();
    facets.sums.push_back(merging.group(root).sums);
    facets.models.push_back(merging.group(root).model);
  }
  return facets;
}

} // namespace

std::uint32_t
groupSurfaces(const GridPoints& points,
              const GridGraph& graph,
              const SensorNoise& noise,
              const SurfaceGroupingOptions& options,
              std::vector<std::uint32_t>& labels,
              std::vector<SurfaceGroup>* groups)
{
  requireValid(points, graph, options);
  TICK("start")
  const KeptEdges edges(points, graph, noise, edgeOptions(options));
  TICK("before const ViewChart chart(")
  const ViewChart chart(points, noise);
  TICK("before SurfaceNodes nodes(")
  SurfaceNodes nodes(points, edges, chart);
  const std::vector<BlockSize> sizes = blockSizes(points.geometry);
  nodes.addBlocks(sizes.front(), options.fit_sigmas, options.threads);
  TICK("before const double dispersion")
  const double dispersion =
      options.points_per_sample > 0.0
          ? options.points_per_sample * nodes.varianceScale()
          : noiseDispersion(points.geometry, nodes, chart, sizes.front());
  const SurfaceCriterion criterion(chart, options, dispersion, nodes.varianceScale());
  if (getenv("DBG")) printf("lambda %g v %g\n", dispersion, nodes.varianceScale());
  TICK("before SurfaceMerging merging(")
  SurfaceMerging merging(criterion);
  merging.add(nodes, nodes.links(0, options.threads));
  TICK("links")
  merging.mergeWhileBetter();
  TICK("before for (std::size_t rate = 1")
  for (std::size_t rate = 1; rate < sizes.size(); ++rate) {
    const std::uint32_t first = nodes.count();
    nodes.addBlocks(sizes[rate], options.fit_sigmas, options.threads);
    merging.add(nodes, nodes.links(first, options.threads));
    merging.joinLikeliest(first);
    TICK("links")
  merging.mergeWhileBetter();
  }
  TICK("before const SurfaceFacets facets =")
  const SurfaceFacets facets = facetsOf(merging, nodes.count());
  const JoiningInput input{points, chart, nodes, facets, criterion, options};
  DisjointSets surfaces(facets.count());
  CellFacets cells(input, edges);
  TICK("before cells.grow(")
  cells.grow(options.point_sigmas);
  TICK("before dropRedundant")
  dropRedundantFacets(input, edges, cells);
  TICK("before cells.refine()")
  cells.refine();
  TICK("before if (options.join_smooth)")
  if (options.join_smooth)
    joinSmooth(input, edges, cells.labels(), sizes.front(), surfaces);
  TICK("before if (options.join_sep")
  if (options.join_separated)
    joinSeparated(input, surfaces);
  TICK("before surfaces.grow(")
  surfaces.grow(cells.addLeftOver(facets.count()));
  TICK("before return labelSurfaces(")
  return labelSurfaces(input, edges, cells.labels(), surfaces, labels, groups);
}

} // namespace nurbs
} // namespace pcl
