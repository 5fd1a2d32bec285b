// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/scan_matching.h>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A map and coarser ones of the same points, so that rough guesses come home.
 *
 * A scan is first aligned, thinned, where voxels are largest: pairs may be far apart
 * there and a step is cheap. Each finer map begins where the coarser one ended. Const
 * calls may run in several threads at a time. \ingroup registration */
class PCL_NURBS_REGISTRATION_EXPORT MapPyramid {
public:
  /** \param[in] fine the map that decides
   * \param[in] coarser number of maps above it, each with voxels of twice the size;
   * fewer where all points would lie in some 30 voxels. O(voxels)
   * \throws std::invalid_argument when \a coarser is negative */
  explicit MapPyramid(VoxelMap fine, int coarser = 4);

  const VoxelMap&
  fine() const
  {
    return maps_.front();
  }

  /** \brief Align a scan: matchScan() on each map, from the coarsest one.
   *
   * Coarse maps use point-to-plane distances whatever the options say, and are left out
   * where their voxels are larger than MatchOptions::max_distance. What a
   * coarse map found is passed on only when it fits the next map better than the guess
   * does. Errors as of matchScan(), which the result is of
   * on the finest map; MatchResult::iterations counts all.
   * \param[in] scan, normals, guess, options see matchScan() */
  MatchResult
  match(const ScanPoints& scan,
        const ScanPoints& normals,
        const Eigen::Isometry3d& guess,
        const MatchOptions& options) const;

private:
  std::vector<VoxelMap> maps_; // from fine to coarse
};

} // namespace nurbs
} // namespace pcl
