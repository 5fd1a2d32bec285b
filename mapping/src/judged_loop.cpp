// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "judged_loop.h"

#include "chi_square.h"

namespace pcl {
namespace nurbs {
namespace {

Measurement
withNoiseScaled(const Measurement& measurement, const NoiseScale& scale)
{
  Measurement result = measurement;
  const NoiseScale inverse{1.0 / scale.translation, 1.0 / scale.rotation};
  if (auto* between = std::get_if<BetweenFactor>(&result))
    between->information = inverse.applyTo(between->information);
  return result;
}

} // namespace

JudgedLoop
judgedLoop(const PoseGraph& graph,
           FactorId id,
           const BetweenFactor& between,
           double probability)
{
  JudgedLoop loop;
  loop.measured = measuredLoop(graph, id, between);
  loop.factor = problemFactorOf(id, {between, 1.0}, graph, PoseGraphCost::Information);
  loop.limit = chiSquareQuantile(loop.measured.planar ? 3 : 6, probability);
  return loop;
}

void
JudgedGraph::judge(
    JudgedLoop& loop, LoopCheck check, double distance, double limit, bool accepted)
{
  loop.verdict = {loop.verdict.factor, accepted, check, distance, limit};
  graph.setWeight(loop.factor.id, accepted ? 1.0 : 0.0);
}

double
JudgedGraph::residualOf(const JudgedLoop& loop) const
{
  return costOf(loop.factor,
                toSolverPose(graph.node(loop.measured.from).T_world_node),
                toSolverPose(graph.node(loop.measured.to).T_world_node));
}

JudgedGraph
judgedGraph(const PoseGraph& graph,
            const std::set<FactorId>& loops,
            const NoiseScale& scale,
            double probability)
{
  JudgedGraph result;
  result.graph = graph;
  for (const auto& [id, factor] : graph.factors())
    result.graph.removeFactor(id);
  for (const auto& [id, factor] : graph.factors()) {
    const FactorId name =
        result.graph.addFactor(withNoiseScaled(factor.measurement, scale));
    if (loops.count(id) == 0) {
      result.graph.setWeight(name, factor.weight);
      continue;
    }
    result.loops.push_back(
        judgedLoop(result.graph,
                   name,
                   std::get<BetweenFactor>(result.graph.factor(name).measurement),
                   probability));
    result.loops.back().verdict.factor = id;
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
