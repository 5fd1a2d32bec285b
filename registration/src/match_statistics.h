// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "match_pairs.h"

namespace pcl {
namespace nurbs {

/** d(point moved by a tangent) / d tangent, in the scan's frame. */
Eigen::Matrix<double, 3, 6>
pointJacobian(const Eigen::Vector3f& point);

/** What the errors of a plane's normal seem to hold, though they hold nothing: the
 * expected part of n n' that is due to them. */
TangentMatrix
normalNoise(const Eigen::Matrix<double, 3, 6>& jacobian,
            const Eigen::Matrix3d& rotation,
            const LocalSurface& surface);

/** Fill in what is known about the result at its pose, from pairs that are up to date
 * with it. */
void
describeMatch(const MatchPairs& pairs,
              const ScanPoints& scan,
              const RobustKernel& kernel,
              const MatchOptions& options,
              double voxel_size,
              MatchResult& result);

} // namespace nurbs
} // namespace pcl
