// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "judged_loop.h"

#include <functional>

namespace pcl {
namespace nurbs {

/** Optimises the graph with the loops' present weights. */
using GraphSolver = std::function<void()>;

/** Optimise and reweight the loops that are accepted so far until the weights stay, then
 * reject those that lost theirs. Weights are left at 1 or 0. */
void
rejectByGraduatedNonConvexity(PoseGraph& graph,
                              std::vector<JudgedLoop>& loops,
                              const RobustOptions& options,
                              const GraphSolver& solve);

/** \copydoc rejectByGraduatedNonConvexity */
void
rejectBySwitches(PoseGraph& graph,
                 std::vector<JudgedLoop>& loops,
                 const RobustOptions& options,
                 const GraphSolver& solve);

} // namespace nurbs
} // namespace pcl
