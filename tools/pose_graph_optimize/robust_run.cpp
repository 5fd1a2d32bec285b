// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "robust_run.h"

#include <cstdio>

namespace pcl_nurbs_tools {

using namespace pcl::nurbs;

namespace {

nlohmann::json
reportOf(const PoseGraph& graph, const RobustSummary& summary)
{
  nlohmann::json rejected = nlohmann::json::array();
  for (const LoopVerdict& loop : summary.loops) {
    if (loop.accepted)
      continue;
    const auto& edge = std::get<BetweenFactor>(graph.factor(loop.factor).measurement);
    rejected.push_back({{"from", edge.from},
                        {"to", edge.to},
                        {"check", nameOf(loop.check)},
                        {"distance", loop.distance},
                        {"limit", loop.limit}});
  }
  return {{"loops", summary.loops.size()},
          {"accepted", summary.loops.size() - rejected.size()},
          {"rejected", rejected},
          {"translation_scale", summary.translation_scale},
          {"rotation_scale", summary.rotation_scale},
          {"solutions", summary.solutions},
          {"clique_proven", summary.clique_proven}};
}

} // namespace

RobustRun
runRobustly(PoseGraph graph, RobustMethod method, const PoseGraphOptions& options)
{
  RobustOptions robust;
  robust.method = method;
  robust.solver = options;
  const RobustSummary summary = optimizeRobustly(graph, robust);
  RobustRun run{graph, summary.solution, reportOf(graph, summary)};
  for (const FactorId id : summary.rejected())
    run.graph.removeFactor(id);
  return run;
}

void
printRobust(const nlohmann::json& report)
{
  std::printf("%zu of %zu loops rejected\n",
              report["rejected"].size(),
              report["loops"].get<std::size_t>());
}

} // namespace pcl_nurbs_tools
