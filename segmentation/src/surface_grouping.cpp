// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/surface_grouping.h>

#include "facet_selection.h"
#include "noise_dispersion.h"
#include "surface_borders.h"
#include "surface_labels.h"
#include "surface_merging.h"
#include "surface_stages.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

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

/** Share of the cells that hold a point where there are any. */
double
fillOf(const GridPoints& points)
{
  constexpr int kSide = 8;
  const int width = points.geometry.width;
  const int height = points.geometry.height;
  std::size_t valid = 0;
  std::size_t all = 0;
  for (int top = 0; top < height; top += kSide)
    for (int left = 0; left < width; left += kSide) {
      std::size_t here = 0;
      std::size_t cells = 0;
      for (int row = top; row < std::min(top + kSide, height); ++row)
        for (int column = left; column < std::min(left + kSide, width); ++column) {
          here += points.valid(static_cast<std::size_t>(row * width + column)) ? 1 : 0;
          ++cells;
        }
      valid += here;
      all += here > 0 ? cells : 0;
    }
  return static_cast<double>(std::max<std::size_t>(valid, 1)) /
         static_cast<double>(std::max<std::size_t>(all, 1));
}

/** Blocks, coarse to fine, about as wide as high on a surface that faces the sensor,
 * and the larger the fewer cells hold a point. */
std::vector<BlockSize>
blockSizes(const GridPoints& points)
{
  const GridGeometry& grid = points.geometry;
  const int fine = 4 * static_cast<int>(std::lround(std::sqrt(1.0 / fillOf(points))));
  constexpr double kMostStretch = 4.0;
  const double across = grid.columnSpacing(1.0);
  const double down = grid.rowSpacing(1.0);
  double stretch = across > 0.0 && down > 0.0 ? down / across : 1.0;
  stretch = std::clamp(stretch, 1.0 / kMostStretch, kMostStretch);
  const int columns = fine * std::max(1, static_cast<int>(std::lround(stretch)));
  const int rows = fine * std::max(1, static_cast<int>(std::lround(1.0 / stretch)));
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

SensorNoise
scaled(const SensorNoise& noise, double scale)
{
  return {scale * noise.constant, scale * noise.quadratic, noise.reference};
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

/** Merges nodes of the coarsest rate, which are there, then rate by rate those of the
 * finer ones. */
SurfaceFacets
facetsOf(const SurfaceCriterion& criterion,
         const SurfaceGroupingOptions& options,
         const std::vector<BlockSize>& sizes,
         SurfaceNodes& nodes)
{
  SurfaceMerging merging(criterion, options.threads);
  merging.add(nodes, nodes.links(0, options.threads));
  merging.mergeWhileBetter();
  for (std::size_t rate = 1; rate < sizes.size(); ++rate) {
    const std::uint32_t first = nodes.count();
    nodes.addBlocks(sizes[rate], options.fit_sigmas, options.threads);
    merging.add(nodes, nodes.links(first, options.threads));
    merging.joinLikeliest(first);
    merging.mergeWhileBetter();
  }
  return facetsOf(merging, nodes.count());
}

} // namespace

std::uint32_t
groupSurfacesAnd(SurfaceStages& stages,
                 const GridPoints& points,
                 const GridGraph& graph,
                 const SensorNoise& noise,
                 const SurfaceGroupingOptions& options,
                 std::vector<std::uint32_t>& labels,
                 std::vector<SurfaceGroup>* groups)
{
  requireValid(points, graph, options);
  const std::vector<BlockSize> sizes = blockSizes(points);
  ViewChart chart(points, noise, graph, options.threads);
  const double scale = measureNoiseScale(points, chart, sizes.front(), options.threads);
  chart.scaleNoise(scale);
  chart.measureDirections(graph, options.threads);
  const KeptEdges edges(points,
                        graph,
                        scaled(noise, scale),
                        edgeOptions(options),
                        chart.directionNoise());
  SurfaceNodes nodes(points, edges, chart);
  nodes.addBlocks(sizes.front(), options.fit_sigmas, options.threads);
  const double dispersion =
      options.points_per_sample > 0.0
          ? options.points_per_sample
          : noiseDispersion(points.geometry, nodes, chart, sizes.front());
  const SurfaceCriterion criterion(chart, options, dispersion);
  const SurfaceFacets facets = facetsOf(criterion, options, sizes, nodes);
  const JoiningInput input{points, chart, nodes, facets, criterion, options};
  CellFacets cells(input, edges);
  cells.grow(options.point_sigmas);
  dropRedundantFacets(input, edges, cells);
  cells.refine();
  const std::uint32_t count = cells.addLeftOver(facets.count());
  const FacetCells facet_cells{cells.labels(), count, sizes.front()};
  const std::vector<std::uint32_t> parts =
      stages.partOfFacet(input, edges, facet_cells);
  DisjointSets surfaces(count);
  if (options.join_smooth)
    joinSmooth(input, edges, facet_cells, parts, surfaces);
  if (options.join_separated)
    joinSeparated(input, facet_cells, surfaces);
  return labelSurfaces(input, cells.labels(), surfaces, labels, groups);
}

std::uint32_t
groupSurfaces(const GridPoints& points,
              const GridGraph& graph,
              const SensorNoise& noise,
              const SurfaceGroupingOptions& options,
              std::vector<std::uint32_t>& labels,
              std::vector<SurfaceGroup>* groups)
{
  SurfaceStages none;
  return groupSurfacesAnd(none, points, graph, noise, options, labels, groups);
}

} // namespace nurbs
} // namespace pcl
