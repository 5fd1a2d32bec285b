// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "judged_loop.h"

namespace pcl {
namespace nurbs {

/** Optimise and reweight the loops that are accepted so far until the weights stay,
 * then reject those that lost theirs. Weights are left at 1 or 0. */
void
rejectByGraduatedNonConvexity(JudgedGraph& judged, const RobustOptions& options);

/** \copydoc rejectByGraduatedNonConvexity */
void
rejectBySwitches(JudgedGraph& judged, const RobustOptions& options);

} // namespace nurbs
} // namespace pcl
