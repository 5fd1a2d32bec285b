// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/trimmed_surface.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief How well a patch explains the points it was made from. Distances are
 * orthogonal, in metres. */
struct PatchQuality {
  std::uint64_t points = 0; /**< number of points the patch explains */
  double noise = 0.0;       /**< standard deviation of the points' noise */
  double rmse = 0.0;        /**< root mean square distance */
  double max = 0.0;         /**< largest distance */
};

/** \brief A trimmed surface with the identity and the quality of its fit. */
struct SurfacePatch {
  TrimmedSurface geometry;
  std::uint32_t label = 0; /**< segment the patch came from; 0 is none */
  PatchQuality quality;
};

/** \brief A set of patches in one frame: what a point cloud becomes, and what the file
 * formats read and write.
 * \ingroup surface
 */
struct SurfaceModel {
  std::vector<SurfacePatch> patches;
  std::string frame_id;                        /**< frame of the control points */
  std::map<std::string, std::string> metadata; /**< free text: source, options, ... */

  /** \brief Number of control points of all patches. */
  std::size_t
  numControlPoints() const
  {
    std::size_t sum = 0;
    for (const SurfacePatch& patch : patches)
      sum += static_cast<std::size_t>(patch.geometry.surface().numControlPoints());
    return sum;
  }
};

} // namespace nurbs
} // namespace pcl
