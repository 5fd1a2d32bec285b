// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "pose_graph_problem.h"

namespace pcl {
namespace nurbs {

/** Pairs of variables that stand together in a row of a sparse least-squares problem.
 */
using VariablePairs = std::vector<std::pair<int, int>>;

/** Order in which to eliminate variables 0 ... count - 1 so that a Cholesky factor of
 * their normal equations stays sparse: minimum degree or nested dissection, whichever
 * fills less (CHOLMOD). */
std::vector<int>
eliminationOrder(int count, const VariablePairs& pairs);

/** The same for the poses of a graph that are not held, as their indices. */
std::vector<int>
eliminationOrder(const PoseGraphProblem& problem);

} // namespace nurbs
} // namespace pcl
