// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "loop_cycles.h"
#include "pose_graph_problem.h"

#include <pcl/mapping/pose_graph_robust.h>

namespace pcl {
namespace nurbs {

/** A loop while it is being judged. */
struct JudgedLoop {
  MeasuredLoop measured;
  ProblemFactor factor; /**< of weight 1 */
  double limit = 0.0;   /**< of squared distances */
  LoopVerdict verdict;
};

JudgedLoop
judgedLoop(const PoseGraph& graph, FactorId id, double probability);

/** Degrees of freedom of its error. */
int
freedomOf(const MeasuredLoop& loop);

/** x of which a chi square variable is less with this probability. */
double
chiSquareQuantile(int freedom, double probability);

/** Squared distance of the loop's measurement from the estimates, d^2 of its own
 * covariance alone. */
double
residualOf(const JudgedLoop& loop, const PoseGraph& graph);

} // namespace nurbs
} // namespace pcl
