// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pose_graph_solver.h>

#include <cmath>
#include <queue>
#include <random>
#include <set>

namespace pcl {
namespace nurbs {
namespace {

/** Goes along between factors from poses that are known to others, those of consecutive
 * names first. */
class ChainWalk {
public:
  explicit ChainWalk(PoseGraph& graph) : graph_(graph) {}

  void
  start(NodeId id)
  {
    known_.insert(id);
    queueFactorsOf(id);
  }

  bool
  knows(NodeId id) const
  {
    return known_.count(id) > 0;
  }

  void
  run()
  {
    while (!queue_.empty()) {
      const Step step = queue_.top();
      queue_.pop();
      if (known_.count(step.to) == 0)
        take(step);
    }
  }

private:
  struct Step {
    std::uint64_t gap; // between the names
    FactorId factor;
    NodeId from;
    NodeId to;

    bool
    operator<(const Step& other) const
    {
      return std::tie(gap, factor, to) > std::tie(other.gap, other.factor, other.to);
    }
  };

  void
  take(const Step& step)
  {
    const auto& between =
        std::get<BetweenFactor>(graph_.factor(step.factor).measurement);
    const Eigen::Isometry3d motion =
        between.from == step.from ? between.T_from_to : between.T_from_to.inverse();
    graph_.setPose(step.to, orthonormal(graph_.node(step.from).T_world_node * motion));
    start(step.to);
  }

  void
  queueFactorsOf(NodeId id)
  {
    for (const FactorId factor : graph_.node(id).factors) {
      const PoseFactor& entry = graph_.factor(factor);
      const auto* between = std::get_if<BetweenFactor>(&entry.measurement);
      if (between == nullptr || entry.weight == 0.0)
        continue;
      const NodeId other = between->from == id ? between->to : between->from;
      if (known_.count(other) == 0)
        queue_.push({std::max(id, other) - std::min(id, other), factor, id, other});
    }
  }

  PoseGraph& graph_;
  std::set<NodeId> known_;
  std::priority_queue<Step> queue_;
};

/** Where a part begins: at the pose of a prior if there is one. */
void
placeFirst(PoseGraph& graph, NodeId id)
{
  for (const FactorId factor : graph.node(id).factors)
    if (const auto* prior =
            std::get_if<PriorFactor>(&graph.factor(factor).measurement)) {
      graph.setPose(id, prior->T_world_node);
      return;
    }
  if (!graph.node(id).has_estimate)
    graph.setPose(id, Eigen::Isometry3d::Identity());
}

void
walkParts(PoseGraph& graph, ChainWalk& walk)
{
  walk.run();
  for (const std::vector<NodeId>& part : graph.components())
    for (const NodeId id : part)
      if (!walk.knows(id)) {
        placeFirst(graph, id);
        walk.start(id);
        walk.run();
      }
}

double
meanLength(const PoseGraph& graph)
{
  double sum = 0.0;
  std::size_t count = 0;
  for (const auto& [id, factor] : graph.factors())
    if (const auto* between = std::get_if<BetweenFactor>(&factor.measurement)) {
      sum += between->T_from_to.translation().norm();
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : 1.0;
}

} // namespace

void
completeEstimates(PoseGraph& graph)
{
  ChainWalk walk(graph);
  bool complete = true;
  for (const auto& [id, node] : graph.nodes())
    complete = complete && node.has_estimate;
  if (complete)
    return;
  for (const auto& [id, node] : graph.nodes())
    if (node.has_estimate)
      walk.start(id);
  walkParts(graph, walk);
}

void
initializeFromOdometry(PoseGraph& graph)
{
  ChainWalk walk(graph);
  for (const auto& [id, node] : graph.nodes())
    if (node.fixed)
      walk.start(id);
  walkParts(graph, walk);
}

void
initializeRandomly(PoseGraph& graph, unsigned seed)
{
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  const double side =
      meanLength(graph) * std::cbrt(static_cast<double>(graph.nodes().size()));
  std::uniform_real_distribution<double> place(-0.5 * side, 0.5 * side);
  for (const auto& [id, node] : graph.nodes()) {
    if (node.fixed)
      continue;
    Eigen::Quaterniond rotation(0.0, 0.0, 0.0, 0.0);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (Eigen::Index k = 0; k < (node.planar ? 2 : 3); ++k)
      pose.translation()(k) = place(generator);
    if (!node.planar)
      rotation.x() = normal(generator), rotation.y() = normal(generator);
    rotation.z() = normal(generator);
    rotation.w() = normal(generator);
    pose.linear() = rotation.normalized().toRotationMatrix();
    graph.setPose(id, pose);
  }
}

} // namespace nurbs
} // namespace pcl
