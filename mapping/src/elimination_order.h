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

/** Order for variables 0 ... count - 1 that stand together in rows, the \a last ones at
 * the end (CCOLAMD).
 * \param[in] last by variable, 1 to be among the last, else 0 */
std::vector<int>
constrainedOrder(const std::vector<std::vector<int>>& rows,
                 const std::vector<int>& last);

/** eliminationOrder() of the poses of a graph that are not held, as their indices. */
std::vector<int>
eliminationOrder(const PoseGraphProblem& problem);

} // namespace nurbs
} // namespace pcl
