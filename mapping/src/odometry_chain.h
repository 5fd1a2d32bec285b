// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph.h>

namespace pcl {
namespace nurbs {

/** Give poses to the nodes that have none, going along the between factors from those
 * that have. */
void
completeFromOdometry(PoseGraph& graph);

} // namespace nurbs
} // namespace pcl
