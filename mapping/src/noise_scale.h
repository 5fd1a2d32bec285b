// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "loop_cycles.h"

namespace pcl {
namespace nurbs {

/** How much better the cycles of loops with the odometry close than information matrices
 * say, never worse. First the rotations, which no translation disturbs, then the
 * translations with what the rotations explain. From the lower quartile of the shorter
 * half of the cycles, which false loops hardly touch as long as they are no more than the
 * true ones; one if there are too few. Twice the scale is returned: errors have longer
 * tails than their middle tells.
 * \param[in] loops their names */
NoiseScale
estimateNoiseScale(const PoseGraph& graph, const std::set<FactorId>& loops);

} // namespace nurbs
} // namespace pcl
