// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "surface_joining.h"

#include <vector>

namespace pcl {
namespace nurbs {

/** What else is done while groupSurfaces() has its models and edges at hand. */
class SurfaceStages {
public:
  virtual ~SurfaceStages() = default;

  /** Facets are joined to surfaces only within the same part; all are in one when this
   * is empty. */
  virtual std::vector<std::uint32_t>
  partOfFacet(const JoiningInput&, const KeptEdges&, const FacetCells&)
  {
    return {};
  }
};

/** groupSurfaces() with further stages. */
std::uint32_t
groupSurfacesAnd(SurfaceStages& stages,
                 const GridPoints& points,
                 const GridGraph& graph,
                 const SensorNoise& noise,
                 const SurfaceGroupingOptions& options,
                 std::vector<std::uint32_t>& labels,
                 std::vector<SurfaceGroup>* groups);

} // namespace nurbs
} // namespace pcl
