// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "incremental_run.h"

#include <pcl/mapping/stop_watch.h>

#include <algorithm>

namespace pcl_nurbs_tools {
namespace {

using namespace pcl::nurbs;

/** Factors by the last of their nodes; those to the nearest one first, from which a new
 * node gets its pose. */
std::map<NodeId, std::vector<Measurement>>
factorsByLastNode(const PoseGraph& graph)
{
  std::map<NodeId, std::vector<Measurement>> result;
  const auto firstOf = [](const Measurement& measurement) {
    const std::vector<NodeId> nodes = nodesOf(measurement);
    return *std::min_element(nodes.begin(), nodes.end());
  };
  for (const auto& [id, factor] : graph.factors()) {
    const std::vector<NodeId> nodes = nodesOf(factor.measurement);
    result[*std::max_element(nodes.begin(), nodes.end())].push_back(factor.measurement);
  }
  for (auto& [id, factors] : result)
    std::stable_sort(factors.begin(),
                     factors.end(),
                     [&](const Measurement& a, const Measurement& b) {
                       return firstOf(a) > firstOf(b);
                     });
  return result;
}

} // namespace

IncrementalRun
runIncrementally(const PoseGraph& graph,
                 const PoseGraphOptions& options,
                 const std::function<void(double)>& progress)
{
  const auto factors = factorsByLastNode(graph);
  IncrementalOptions settings;
  settings.cost = options.cost;
  IncrementalPoseGraph growing(settings);
  IncrementalRun result;
  const auto count = static_cast<double>(graph.nodes().size());
  for (const auto& [id, node] : graph.nodes()) {
    StopWatch watch;
    const auto own = factors.find(id);
    if (node.has_estimate && (own == factors.end() || node.fixed))
      growing.addNode(id, node.T_world_node, node.planar);
    else
      growing.addNode(id, node.planar);
    if (node.fixed)
      growing.setFixed(id, true);
    if (own != factors.end())
      for (const Measurement& measurement : own->second)
        growing.addFactor(measurement);
    const IncrementalUpdate update = growing.update();
    result.seconds.push_back(watch.lap());
    result.eliminated += static_cast<double>(update.eliminated) / count;
    result.solved += static_cast<double>(update.solved) / count;
    progress(static_cast<double>(result.seconds.size()) / count);
    if (options.interrupted && options.interrupted())
      break;
  }
  result.cost_before_all = costOf(growing.graph(), options.cost);
  result.all = growing.optimizeAll(options);
  result.graph = growing.graph();
  return result;
}

} // namespace pcl_nurbs_tools
