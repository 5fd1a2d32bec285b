// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "loop_cycles.h"

namespace pcl {
namespace nurbs {

/** How much better the cycles of loops with the odometry close than information
 * matrices say, never worse. First the rotations, which no translation disturbs, then
 * the translations with what the rotations explain, never less than the rotations: what
 * they explain alone says nothing about translations. From the lower quartile of the
 * cycles or of their shorter half, whichever is smaller; false loops hardly touch it as
 * long as they are no more than the true ones. One if there are too few. Twice the
 * scale is returned: errors have longer tails than their middle tells.
 * \param[in] loops their names */
NoiseScale
estimateNoiseScale(const PoseGraph& graph, const std::set<FactorId>& loops);

} // namespace nurbs
} // namespace pcl
