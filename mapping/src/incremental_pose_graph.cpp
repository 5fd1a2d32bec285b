// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/incremental_pose_graph.h>

#include "incremental_equations.h"

#include <stdexcept>

namespace pcl {
namespace nurbs {

class IncrementalPoseGraph::Implementation {
public:
  explicit Implementation(const IncrementalOptions& settings)
      : options(settings), equations(graph, settings.cost)
  {
  }

  /** Give the first pose to the nodes of a measurement that have none. */
  void
  placeNodes(const Measurement& measurement)
  {
    if (const auto* between = std::get_if<BetweenFactor>(&measurement)) {
      if (!graph.node(between->from).has_estimate &&
          !graph.node(between->to).has_estimate)
        graph.setPose(between->from, Eigen::Isometry3d::Identity());
      placeNode(between->from, between->to, between->T_from_to.inverse());
      placeNode(between->to, between->from, between->T_from_to);
      return;
    }
    const NodeId id = nodesOf(measurement).front();
    if (graph.node(id).has_estimate)
      return;
    const auto* prior = std::get_if<PriorFactor>(&measurement);
    graph.setPose(
        id, prior != nullptr ? prior->T_world_node : Eigen::Isometry3d::Identity());
  }

  void
  synchronize()
  {
    for (const NodeId id : equations.takeMoved())
      graph.setPose(id, toIsometry(equations.pose(id)));
  }

  IncrementalUpdate
  update()
  {
    IncrementalUpdate result =
        rebuild_is_due ? equations.rebuild() : equations.update(options);
    rebuild_is_due = false;
    for (int step = 1; step < options.max_steps; ++step) {
      const IncrementalUpdate more = equations.update(options);
      if (more.relinearized == 0)
        break;
      result.eliminated += more.eliminated;
      result.relinearized += more.relinearized;
      result.solved += more.solved;
      result.all = result.all || more.all;
    }
    return result;
  }

  IncrementalOptions options;
  PoseGraph graph;
  IncrementalEquations equations;
  bool rebuild_is_due = false;

private:
  void
  placeNode(NodeId id, NodeId other, const Eigen::Isometry3d& T_other_node)
  {
    if (graph.node(id).has_estimate)
      return;
    const Eigen::Isometry3d T_world_other = equations.has(other)
                                                ? toIsometry(equations.pose(other))
                                                : graph.node(other).T_world_node;
    graph.setPose(id, orthonormal(T_world_other * T_other_node));
  }
};

void
IncrementalOptions::validate() const
{
  if (!(relinearize_rotation >= 0.0) || !(relinearize_translation >= 0.0) ||
      !(solve_threshold >= 0.0))
    throw std::invalid_argument("thresholds must not be negative");
  if (max_steps < 1)
    throw std::invalid_argument("the number of steps must be positive");
}

IncrementalOptions
IncrementalOptions::exact()
{
  IncrementalOptions options;
  options.relinearize_rotation = 1e-4;
  options.relinearize_translation = 1e-3;
  options.solve_threshold = 1e-6;
  options.max_steps = 3;
  return options;
}

IncrementalPoseGraph::IncrementalPoseGraph(const IncrementalOptions& options)
{
  options.validate();
  implementation_ = std::make_unique<Implementation>(options);
}

IncrementalPoseGraph::IncrementalPoseGraph(PoseGraph graph,
                                           const IncrementalOptions& options)
    : IncrementalPoseGraph(options)
{
  completeEstimates(graph);
  implementation_->graph = std::move(graph);
  implementation_->rebuild_is_due = true;
}

IncrementalPoseGraph::IncrementalPoseGraph(IncrementalPoseGraph&&) noexcept = default;

IncrementalPoseGraph&
IncrementalPoseGraph::operator=(IncrementalPoseGraph&&) noexcept = default;

IncrementalPoseGraph::~IncrementalPoseGraph() = default;

void
IncrementalPoseGraph::addNode(NodeId id, bool planar)
{
  implementation_->graph.addNode(id, planar);
}

void
IncrementalPoseGraph::addNode(NodeId id,
                              const Eigen::Isometry3d& T_world_node,
                              bool planar)
{
  implementation_->graph.addNode(id, T_world_node, planar);
}

FactorId
IncrementalPoseGraph::addFactor(const Measurement& measurement)
{
  PoseGraph& graph = implementation_->graph;
  const FactorId id = graph.addFactor(measurement);
  implementation_->placeNodes(measurement);
  if (!implementation_->rebuild_is_due)
    implementation_->equations.addFactor(id);
  return id;
}

void
IncrementalPoseGraph::removeFactor(FactorId id)
{
  implementation_->synchronize(); // a node without factors keeps its pose
  implementation_->graph.factor(id);
  implementation_->equations.removeFactor(id);
  implementation_->graph.removeFactor(id);
}

void
IncrementalPoseGraph::removeNode(NodeId id)
{
  const std::vector<FactorId> factors = implementation_->graph.node(id).factors;
  for (const FactorId factor : factors)
    removeFactor(factor);
  implementation_->graph.removeNode(id);
}

void
IncrementalPoseGraph::setWeight(FactorId id, double weight)
{
  implementation_->synchronize();
  implementation_->graph.setWeight(id, weight);
  if (implementation_->rebuild_is_due)
    return;
  implementation_->equations.removeFactor(id);
  implementation_->equations.addFactor(id);
}

void
IncrementalPoseGraph::setFixed(NodeId id, bool fixed)
{
  implementation_->synchronize();
  implementation_->graph.setFixed(id, fixed);
  implementation_->rebuild_is_due = true;
}

IncrementalUpdate
IncrementalPoseGraph::update()
{
  return implementation_->update();
}

PoseGraphSummary
IncrementalPoseGraph::optimizeAll(const PoseGraphOptions& options)
{
  PoseGraphOptions settings = options;
  settings.cost = implementation_->options.cost;
  implementation_->synchronize();
  const PoseGraphSummary summary = optimize(implementation_->graph, settings);
  implementation_->rebuild_is_due = true;
  implementation_->update();
  return summary;
}

Eigen::Isometry3d
IncrementalPoseGraph::pose(NodeId id) const
{
  return implementation_->equations.has(id)
             ? toIsometry(implementation_->equations.pose(id))
             : implementation_->graph.node(id).T_world_node;
}

Eigen::MatrixXd
IncrementalPoseGraph::covariance(const std::vector<NodeId>& ids) const
{
  for (const NodeId id : ids)
    implementation_->graph.node(id);
  return implementation_->equations.covariance(ids);
}

const PoseGraph&
IncrementalPoseGraph::graph() const
{
  implementation_->synchronize();
  return implementation_->graph;
}

} // namespace nurbs
} // namespace pcl
