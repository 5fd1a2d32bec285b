// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "surface_joining.h"

#include "kept_edges.h"

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** Facet of each cell at full resolution. */
class CellFacets {
public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /** Cells of nodes have their node's facet, the others none. */
  CellFacets(const JoiningInput& input, const KeptEdges& edges);

  /** Let facets grow, cell by cell, over kept edges, to points they explain within so
   * many standard deviations. */
  void
  grow(double sigmas);

  /** Connected cells without a facet become new ones without a model, numbered on from
   * \a first, unless they are mere lines. \return number of facets */
  std::uint32_t
  addLeftOver(std::uint32_t first);

  /** Move the borders between facets to where their models intersect: each cell near a
   * border belongs to the model that explains it and its neighbours best. */
  void
  refine();

  const std::vector<std::uint32_t>&
  labels() const
  {
    return facet_;
  }

  /** A point as residual() wants it. */
  ViewSample
  sample(std::size_t cell) const
  {
    return input_.chart.sample(cell);
  }

  /** Square of a point's distance from a facet, in units of the noise, but bounded;
   * facets without a model are as far as it gets. */
  double
  residual(const ViewSample& sample, std::uint32_t facet) const;

  void
  assign(std::size_t cell, std::uint32_t facet)
  {
    facet_[cell] = facet;
  }

private:
  /** Give a cell and the cells without a facet that hang together with it a facet.
   * \param[out] cells all of them */
  void
  spread(std::size_t cell, std::uint32_t facet, std::vector<std::size_t>& cells);

  /** Whether cells, a whole facet, are one or two cells wide. */
  bool
  isLine(const std::vector<std::size_t>& cells) const;

  std::uint32_t
  bestNeighbour(std::size_t cell, double sigmas) const;

  /** Cells without a facet that have a neighbour with one. */
  std::vector<std::size_t>
  besideFacets() const;

  std::vector<std::size_t>
  atBorders() const;

  std::uint32_t
  cheapest(std::size_t cell) const;

  const JoiningInput& input_;
  const KeptEdges& edges_;
  std::vector<std::uint32_t> facet_;
};

} // namespace nurbs
} // namespace pcl
