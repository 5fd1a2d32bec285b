// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "judged_loop.h"

namespace pcl {
namespace nurbs {

/** Accept loops in clusters that confirm each other, those of most evidence first, more
 * each time, by their distances from what odometry and accepted loops say together. */
void
growByEvidence(JudgedGraph& judged,
               const OdometryUncertainty& odometry,
               const RobustOptions& options);

/** Reject accepted loops that are too far from what all others say together, and accept
 * rejected ones that are not, until nothing changes. */
void
checkJointly(JudgedGraph& judged, const RobustOptions& options);

} // namespace nurbs
} // namespace pcl
