// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "loop_cycles.h"
#include "pose_graph_problem.h"

#include <pcl/mapping/pose_graph_robust.h>

#include <functional>

namespace pcl {
namespace nurbs {

/** A loop while it is being judged. */
struct JudgedLoop {
  MeasuredLoop measured;
  ProblemFactor factor; /**< of weight 1 */
  double limit = 0.0;   /**< of squared distances */
  /** What the covariance of the rest of the graph is multiplied by. */
  double growth = 1.0;
  LoopVerdict verdict;
};

/** A copy of a graph with its loops, on which they are judged. */
struct JudgedGraph {
  PoseGraph graph;
  std::vector<JudgedLoop> loops;
  /** Optimises the graph with the loops' present weights. */
  std::function<void()> solve;

  /** Pass a verdict and set the weight accordingly. */
  void
  judge(
      JudgedLoop& loop, LoopCheck check, double distance, double limit, bool accepted);

  /** Squared distance of the loop's measurement from the estimates in units of its own
   * covariance. */
  double
  residualOf(const JudgedLoop& loop) const;
};

/** A loop between nodes of a graph, of which it may be a factor or not. */
JudgedLoop
judgedLoop(const PoseGraph& graph,
           FactorId id,
           const BetweenFactor& between,
           double probability);

/** The graph with the information of between factors for errors scaled so, its loops
 * accepted.
 * \throws as optimizeRobustly() */
JudgedGraph
judgedGraph(const PoseGraph& graph,
            const std::set<FactorId>& loops,
            const NoiseScale& scale,
            double probability);

} // namespace nurbs
} // namespace pcl
