// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "segment_fitting.h"

#include <pcl/surface/nurbs/trimmed_surface.h>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A connected part of a fitted surface that became a patch, and its cells. */
struct TrimmedPart {
  SurfacePatch patch;
  std::vector<std::size_t> members; /**< positions in FittedSurface::cells */
};

/** \brief Cut a fitted surface along the border of its inliers in the grid.
 *
 * Single cells that are missing or out of tolerance among inliers stay inside; larger
 * gaps become holes. Inliers of one segment make one patch, even if they are apart.
 * \param[in] input the cloud
 * \param[in] surface a fit
 * \param[out] part patch and members
 * \return false if less than min_patch_points are left or the surface merely cuts
 * across them */
bool
trimToInliers(const ReconstructionInput& input,
              const FittedSurface& surface,
              TrimmedPart& part);

} // namespace nurbs
} // namespace pcl
