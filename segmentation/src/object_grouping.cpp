// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/segmentation/object_grouping.h>

#include "border_agglomeration.h"
#include "border_fits.h"
#include "grid_steps.h"
#include "surface_stages.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

using Labels = std::vector<std::uint32_t>;
using Pieces = std::vector<std::pair<BorderKey, BorderPiece>>;

/** Largest step (standard deviations) between facets of one smooth surface. */
constexpr double kStepSigmas = 3.0;
/** One curved surface bends less than this (radians) within the reach of two fits. */
constexpr double kMostBend = 0.6;

void
requireValid(const ObjectGroupingOptions& options)
{
  if (!(options.concave_angle >= 0.0) || !(options.least_border >= 0.0))
    throw std::invalid_argument("groupObjects: thresholds must not be negative");
  if (!(options.convex_share > 0.0) || !(options.convex_share <= 1.0))
    throw std::invalid_argument("groupObjects: a share lies between 0 and 1");
}

/** What facets do where they meet. */
enum class Fold { unknown, concave, convex };

Fold
foldOf(const BorderFit& fit, double concave_angle, double outward)
{
  const double cosine = fit.normal[0].dot(fit.normal[1]);
  if (cosine >= std::cos(concave_angle) || (fit.bends && cosine >= std::cos(kMostBend)))
    return fit.step <= kStepSigmas ? Fold::convex : Fold::concave;
  const double opening =
      outward * (fit.normal[0] - fit.normal[1]).dot(fit.middle[0] - fit.middle[1]);
  return opening > 0.0 ? Fold::convex : Fold::concave;
}

std::vector<Fold>
foldsOf(const JoiningInput& input,
        const FacetCells& cells,
        const Pieces& pieces,
        double concave_angle)
{
  const double outward = isInverseDepthGrid(input.points.geometry) ? -1.0 : 1.0;
  const BorderFitter fitter(
      input.points, input.chart, input.criterion, cells.facet, cells.size);
  std::vector<Fold> folds(pieces.size(), Fold::unknown);
#pragma omp parallel for schedule(dynamic, 16) num_threads(input.options.threads)
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto& [key, piece] = pieces[k];
    if (const auto fit = fitter.at(key.a, key.b, piece.middle))
      folds[k] = foldOf(*fit, concave_angle, outward);
  }
  return folds;
}

/** Convex pieces of short borders say nothing: things that touch in a point. */
void
forgetShortBorders(const FacetCells& cells,
                   const Pieces& pieces,
                   double least_border,
                   std::vector<Fold>& folds)
{
  std::vector<double> size(cells.count, 0.0);
  for (const std::uint32_t facet : cells.facet)
    if (facet < cells.count)
      ++size[facet];
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> length;
  for (const auto& [key, piece] : pieces)
    length[{key.a, key.b}] += static_cast<double>(piece.cells);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const BorderKey& key = pieces[k].first;
    const double least = least_border * std::sqrt(std::min(size[key.a], size[key.b]));
    if (folds[k] == Fold::convex && length[{key.a, key.b}] < least)
      folds[k] = Fold::unknown;
  }
}

/** Finds the objects and gives each cell one. */
class ObjectStages : public SurfaceStages {
public:
  ObjectStages(const ObjectGroupingOptions& options, std::vector<std::uint32_t>& labels)
      : options_(options), labels_(labels)
  {
  }

  std::vector<std::uint32_t>
  partOfFacet(const JoiningInput& input,
              const KeptEdges& edges,
              const FacetCells& cells) override
  {
    const Pieces pieces =
        keptBorders(input.points.geometry, edges, cells.facet, cells.count, cells.size)
            .list();
    std::vector<Fold> folds = foldsOf(input, cells, pieces, options_.concave_angle);
    forgetShortBorders(cells, pieces, options_.least_border, folds);
    BorderAgglomeration agglomeration(cells.count);
    for (std::size_t k = 0; k < pieces.size(); ++k)
      if (folds[k] != Fold::unknown)
        agglomeration.add(pieces[k].first.a,
                          pieces[k].first.b,
                          pieces[k].second.cells,
                          folds[k] == Fold::convex);
    DisjointSets objects(cells.count);
    agglomeration.joinInto(objects, options_.convex_share);
    std::vector<std::uint32_t> part(cells.count);
    for (std::uint32_t facet = 0; facet < cells.count; ++facet)
      part[facet] = objects.find(facet);
    numberBySize(cells.facet, part, input.options.min_size);
    fill(input.points, edges);
    return part;
  }

private:
  /** Labels cells by the size of their object; small ones get none. */
  void
  numberBySize(const Labels& facet, const Labels& part, std::size_t least)
  {
    std::vector<std::size_t> size(part.size(), 0);
    for (const std::uint32_t f : facet)
      if (f < part.size())
        ++size[part[f]];
    std::vector<std::uint32_t> order;
    for (std::uint32_t root = 0; root < size.size(); ++root)
      if (size[root] >= std::max<std::size_t>(least, 1))
        order.push_back(root);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) {
      return size[p] > size[q];
    });
    Labels of_root(size.size(), 0);
    for (std::size_t k = 0; k < order.size(); ++k)
      of_root[order[k]] = static_cast<std::uint32_t>(k + 1);
    labels_.assign(facet.size(), 0);
    for (std::size_t cell = 0; cell < facet.size(); ++cell)
      if (facet[cell] < part.size())
        labels_[cell] = of_root[part[facet[cell]]];
  }

  std::uint32_t
  likeliest(const KeptEdges& edges, std::size_t cell) const
  {
    float most = 0.0F;
    std::uint32_t best = 0;
    edges.forEachEdge(cell, [&](std::size_t next, float weight) {
      if (labels_[next] != 0 && weight > most) {
        most = weight;
        best = labels_[next];
      }
    });
    return best;
  }

  /** Cells without an object, ring by ring, join the one a random walker steps to. */
  void
  fill(const GridPoints& points, const KeptEdges& edges)
  {
    std::vector<std::size_t> open;
    for (std::size_t cell = 0; cell < labels_.size(); ++cell)
      if (labels_[cell] == 0 && points.valid(cell))
        open.push_back(cell);
    for (bool grows = true; grows;) {
      Labels chosen;
      for (const std::size_t cell : open)
        chosen.push_back(likeliest(edges, cell));
      std::vector<std::size_t> rest;
      for (std::size_t k = 0; k < open.size(); ++k) {
        labels_[open[k]] = chosen[k];
        if (chosen[k] == 0)
          rest.push_back(open[k]);
      }
      grows = rest.size() < open.size();
      open.swap(rest);
    }
  }

  const ObjectGroupingOptions& options_;
  Labels& labels_;
};

/** What the objects hold. */
std::vector<ObjectGroup>
objectsOf(const Labels& labels, const Labels& surface_labels, std::size_t surfaces)
{
  std::vector<ObjectGroup> objects;
  for (std::size_t cell = 0; cell < labels.size(); ++cell) {
    if (labels[cell] == 0)
      continue;
    objects.resize(std::max<std::size_t>(objects.size(), labels[cell]));
    ++objects[labels[cell] - 1].size;
  }
  std::vector<std::uint32_t> owner(surfaces + 1, 0);
  for (std::size_t cell = 0; cell < labels.size(); ++cell)
    if (surface_labels[cell] != 0 && owner[surface_labels[cell]] == 0)
      owner[surface_labels[cell]] = labels[cell];
  for (std::uint32_t surface = 1; surface <= surfaces; ++surface)
    if (owner[surface] != 0)
      objects[owner[surface] - 1].surfaces.push_back(surface);
  return objects;
}

} // namespace

ObjectGrouping
groupObjects(const GridPoints& points,
             const GridGraph& graph,
             const SensorNoise& noise,
             const SurfaceGroupingOptions& surface_options,
             const ObjectGroupingOptions& options)
{
  requireValid(options);
  ObjectGrouping result;
  SurfaceGroupingOptions apart = surface_options;
  apart.join_separated = false;
  ObjectStages stages(options, result.labels);
  groupSurfacesAnd(
      stages, points, graph, noise, apart, result.surface_labels, &result.surfaces);
  result.objects =
      objectsOf(result.labels, result.surface_labels, result.surfaces.size());
  return result;
}

} // namespace nurbs
} // namespace pcl
