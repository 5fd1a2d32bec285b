// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "disjoint_sets.h"
#include "surface_criterion.h"
#include "surface_nodes.h"

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** Parts of surfaces that one polynomial describes, numbered from 0. */
struct SurfaceFacets {
  std::vector<std::uint32_t> of_node; /**< facet of each node */
  std::vector<ViewSums> sums;
  std::vector<CostedModel> models;

  std::uint32_t
  count() const
  {
    return static_cast<std::uint32_t>(sums.size());
  }
};

/** What joins facets to surfaces looks at. */
struct JoiningInput {
  const GridPoints& points;
  const ViewChart& chart;
  const SurfaceNodes& nodes;
  const SurfaceFacets& facets;
  const SurfaceCriterion& criterion;
  const SurfaceGroupingOptions& options;
};

/** Facets at full resolution, before they are joined to surfaces. */
struct FacetCells {
  const std::vector<std::uint32_t>& facet; /**< of each cell */
  std::uint32_t count; /**< of facets; those beyond the input's have no model */
  BlockSize size;      /**< of the coarsest blocks */
};

/** Join facets that meet without a step or a fold along most of their border: their
 * positions and normals are compared there, by fits to the points near the border on
 * either side. Curved surfaces no single polynomial follows become whole again. O(cells
 * + border cells).
 * \param[in] parts facets of different parts are not joined; empty for one part */
void
joinSmooth(const JoiningInput& input,
           const KeptEdges& edges,
           const FacetCells& cells,
           const std::vector<std::uint32_t>& parts,
           DisjointSets& surfaces);

/** Join facets that one model explains although they do not touch, when the gap between
 * them is no larger than they are and what lies in it does not contradict: an occluder
 * or no reading does not, but points behind the model do, for their rays went through
 * it. O(cells + facets^2). */
void
joinSeparated(const JoiningInput& input,
              const FacetCells& cells,
              DisjointSets& surfaces);

} // namespace nurbs
} // namespace pcl
