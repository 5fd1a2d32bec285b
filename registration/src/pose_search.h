// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/rigid_motion.h>
#include <pcl/registration/voxel_map.h>

#include <Eigen/StdVector>

#include <vector>

namespace pcl {
namespace nurbs {

using Poses =
    std::vector<Eigen::Isometry3d, Eigen::aligned_allocator<Eigen::Isometry3d>>;

/** Where to look for a scan whose place is not known well. */
struct PoseSearchRange {
  /** Turns up to this from the first start, radians ... */
  double max_angle = 2.0;
  /** ... on a lattice of this spacing. */
  double angle_step = 0.25;
  /** Shifts along each axis up to so many cells ... */
  int max_shift = 0;
  /** ... in steps of so many. */
  int shift_step = 3;
};

/** Poses at which a scan fits a map roughly, the best first: a search over turns and
 * shifts in a coarse grid, each result then improved in smaller and smaller steps. They
 * are good to about a third of a cell, and differ from each other.
 *
 * \param[in] starts poses to search around: turns are relative to the first one
 * \param[in] cell_size of the grid, metres; what is farther than 30 cells is not used
 * \param[in] most number of results */
Poses
searchPoses(const VoxelMap& map,
            const ScanPoints& scan,
            const Poses& starts,
            const PoseSearchRange& range,
            double cell_size,
            std::size_t most,
            int threads);

} // namespace nurbs
} // namespace pcl
