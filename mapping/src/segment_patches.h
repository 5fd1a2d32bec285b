// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "segment_fitting.h"

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A segment and all its patches, in the order they were found. */
struct SegmentPatches {
  std::uint32_t label = 0;
  std::vector<SurfacePatch> patches;
  std::vector<CellSet> cells;
  std::vector<std::vector<float>> distances;
  double fit_seconds = 0.0;
  double trim_seconds = 0.0;
};

/** \brief Turn a segment into patches: fit, trim, and try the connected parts of what
 * is left again.
 * \param[in] input the cloud
 * \param[in] segment its cells */
SegmentPatches
patchesOfSegment(const ReconstructionInput& input, CellSet segment);

} // namespace nurbs
} // namespace pcl
