// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "match_pairs.h"

namespace pcl {
namespace nurbs {

/** The derivative of a loss's gradient by the pose, with all that changes on the way:
 * the kernel's weights, and pairs, as a nearest point goes along with a motion on its
 * surface and then holds nothing.
 *
 * Exact for distances to planes. Otherwise from differences at evenly chosen points,
 * as what a nearest point holds is known by its neighbours only. */
TangentMatrix
gradientSlope(const MatchPairs& pairs,
              const ScanPoints& scan,
              const Eigen::Isometry3d& pose,
              const RobustKernel& kernel,
              const MatchOptions& options,
              double voxel_size);

} // namespace nurbs
} // namespace pcl
