// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pose_graph.h>

#include <algorithm>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kMostOff = 1e-6; // of a rotation from orthonormal, a plane from z = 0

void
requireRigid(const Eigen::Isometry3d& pose, bool planar)
{
  const Eigen::Matrix3d rotation = pose.linear();
  if (!pose.matrix().allFinite())
    throw std::invalid_argument("the pose is not finite");
  if (!(rotation * rotation.transpose()).isIdentity(kMostOff) ||
      rotation.determinant() < 0.0)
    throw std::invalid_argument("the pose is no rigid motion");
  if (planar && (std::abs(pose.translation().z()) > kMostOff ||
                 std::abs(rotation(2, 2) - 1.0) > kMostOff))
    throw std::invalid_argument("the pose is not in the plane");
}

[[noreturn]] void
failUnknown(const char* what, std::uint64_t id)
{
  throw std::out_of_range(std::string("there is no ") + what + ' ' +
                          std::to_string(id));
}

/** Sets of names that are joined one pair at a time. */
class NameSets {
public:
  explicit NameSets(const PoseGraph::Nodes& nodes)
  {
    parents_.reserve(nodes.size());
    for (const auto& [id, node] : nodes)
      parents_.emplace(id, id);
  }

  NodeId
  rootOf(NodeId id)
  {
    NodeId root = id;
    while (parents_[root] != root)
      root = parents_[root];
    while (parents_[id] != root)
      id = std::exchange(parents_[id], root);
    return root;
  }

  void
  join(NodeId a, NodeId b)
  {
    a = rootOf(a);
    b = rootOf(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

private:
  std::unordered_map<NodeId, NodeId> parents_;
};

} // namespace

PoseNode&
PoseGraph::nodeToChange(NodeId id)
{
  const auto found = nodes_.find(id);
  if (found == nodes_.end())
    failUnknown("node", id);
  return found->second;
}

const PoseNode&
PoseGraph::node(NodeId id) const
{
  const auto found = nodes_.find(id);
  if (found == nodes_.end())
    failUnknown("node", id);
  return found->second;
}

const PoseFactor&
PoseGraph::factor(FactorId id) const
{
  const auto found = factors_.find(id);
  if (found == factors_.end())
    failUnknown("factor", id);
  return found->second;
}

void
PoseGraph::addNode(NodeId id, bool planar)
{
  PoseNode node;
  node.planar = planar;
  node.has_estimate = false;
  if (!nodes_.try_emplace(id, std::move(node)).second)
    throw std::invalid_argument("there is a node " + std::to_string(id) + " already");
}

void
PoseGraph::addNode(NodeId id, const Eigen::Isometry3d& T_world_node, bool planar)
{
  requireRigid(T_world_node, planar);
  addNode(id, planar);
  setPose(id, T_world_node);
}

void
PoseGraph::removeNode(NodeId id)
{
  const std::vector<FactorId> attached = node(id).factors;
  for (const FactorId factor : attached)
    removeFactor(factor);
  nodes_.erase(id);
}

void
PoseGraph::setPose(NodeId id, const Eigen::Isometry3d& T_world_node)
{
  PoseNode& node = nodeToChange(id);
  requireRigid(T_world_node, node.planar);
  node.T_world_node = orthonormal(T_world_node);
  node.has_estimate = true;
}

void
PoseGraph::clearPose(NodeId id)
{
  PoseNode& node = nodeToChange(id);
  node.T_world_node.setIdentity();
  node.has_estimate = false;
  node.fixed = false;
}

void
PoseGraph::setFixed(NodeId id, bool fixed)
{
  PoseNode& node = nodeToChange(id);
  if (fixed && !node.has_estimate)
    throw std::invalid_argument("node " + std::to_string(id) +
                                " has no pose to be fixed at");
  node.fixed = fixed;
}

FactorId
PoseGraph::addFactor(const Measurement& measurement)
{
  const std::vector<NodeId> ids = nodesOf(measurement);
  for (const NodeId id : ids)
    node(id);
  const std::string flaw = flawOf(measurement);
  if (!flaw.empty())
    throw std::invalid_argument(flaw);
  const FactorId name = next_factor_++;
  factors_.emplace_hint(factors_.end(), name, PoseFactor{measurement, 1.0});
  for (const NodeId id : ids)
    nodes_.at(id).factors.push_back(name);
  return name;
}

void
PoseGraph::removeFactor(FactorId id)
{
  for (const NodeId node : nodesOf(factor(id).measurement)) {
    std::vector<FactorId>& list = nodes_.at(node).factors;
    list.erase(std::lower_bound(list.begin(), list.end(), id));
  }
  factors_.erase(id);
}

void
PoseGraph::setWeight(FactorId id, double weight)
{
  factor(id);
  if (!(weight >= 0.0) || !std::isfinite(weight))
    throw std::invalid_argument("the weight of a factor must be finite, not negative");
  factors_.at(id).weight = weight;
}

std::vector<std::vector<NodeId>>
PoseGraph::components() const
{
  NameSets sets(nodes_);
  for (const auto& [id, factor] : factors_)
    if (const auto* between = std::get_if<BetweenFactor>(&factor.measurement))
      if (factor.weight > 0.0)
        sets.join(between->from, between->to);
  std::vector<std::vector<NodeId>> result;
  std::unordered_map<NodeId, std::size_t> places; // of roots, smallest of their parts
  for (const auto& [id, node] : nodes_) {
    const auto [place, is_new] = places.try_emplace(sets.rootOf(id), result.size());
    if (is_new)
      result.emplace_back();
    result[place->second].push_back(id);
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
