// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "loop_cycles.h"

namespace pcl {
namespace nurbs {

/** Loops that confirm each other, directly or by others in between. */
struct LoopCluster {
  std::vector<std::size_t> members; /**< places in the list of loops */
  /** Logarithm of how unlikely it is that unrelated loops agree like that with each
   * other. */
  double confirmation = 0.0;
  /** The same with the odometry, too, but for a constant. */
  double evidence = 0.0;
};

/** Twice the logarithm of how many times larger the volume is in which the odometry
 * expects a loop to lead than that of its measurement's noise. */
double
vagueness(const MeasuredLoop& loop, const CycleError& cycle);

/** Two loops are joined when the cycle through both closes so much better than it would
 * if one had nothing to do with the other, but anything that the odometry lets pass,
 * that chance joins a loop to one of its neighbours with 1 - probability at most
 * (likelihood ratios exceed x by chance with 1 / x at most). Only loops whose ends
 * are nearest along the odometry are compared. O(loops^2) comparisons of names.
 * \param[in] loops whose ends the odometry joins
 * \return every loop in one cluster, that of most evidence first */
std::vector<LoopCluster>
clusterLoops(const std::vector<MeasuredLoop>& loops,
             const OdometryUncertainty& odometry,
             double probability);

} // namespace nurbs
} // namespace pcl
