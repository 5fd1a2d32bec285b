// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "judged_loop.h"

namespace pcl {
namespace nurbs {

/** Keep the largest set of accepted loops that agree pairwise.
 * \return whether it is known to be the largest */
bool
rejectByPairs(JudgedGraph& judged,
              const OdometryUncertainty& odometry,
              const RobustOptions& options);

} // namespace nurbs
} // namespace pcl
