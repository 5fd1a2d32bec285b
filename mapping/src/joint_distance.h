// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "judged_loop.h"

#include <pcl/mapping/pose_graph_covariance.h>

namespace pcl {
namespace nurbs {

/** d^2 of a loop from what all other factors of a graph say together, at its estimates:
 * r^T (C + J P J^T)^-1 r for a loop that is not in the graph, C its own covariance and
 * P that of the poses. For one that is in the graph, C - J P J^T: the distance it would
 * have if the graph were solved without it, to first order. Directions in which the
 * loop alone determines the poses do not count.
 * \param[in] poses covariance of the graph's poses \param[in] in_graph with weight 1, or
 * weight 0 */
double
jointDistance(const PoseGraph& graph,
              const PoseGraphCovariance& poses,
              const JudgedLoop& loop,
              bool in_graph);

} // namespace nurbs
} // namespace pcl
