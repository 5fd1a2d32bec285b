// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/loop_gate.h>

#include "joint_distance.h"
#include "loop_clusters.h"

#include <algorithm>
#include <limits>

namespace pcl {
namespace nurbs {
namespace {

/** Factors along the shortest way between two nodes that does not use one of these. */
int
stepsBetween(const PoseGraph& graph,
             NodeId from,
             NodeId to,
             const BetweenFactor* unused)
{
  std::set<NodeId> seen{from};
  std::vector<NodeId> front{from};
  int steps = 0;
  for (; !front.empty() && seen.count(to) == 0; ++steps) {
    std::vector<NodeId> next;
    for (const NodeId node : front)
      for (const FactorId id : graph.node(node).factors) {
        const auto* between = std::get_if<BetweenFactor>(&graph.factor(id).measurement);
        if (between == nullptr || between == unused)
          continue;
        const NodeId other = between->from == node ? between->to : between->from;
        if (seen.insert(other).second)
          next.push_back(other);
      }
    front = std::move(next);
  }
  return steps;
}

/** One Gauss-Newton step after the other, until no pose moves far any more. */
void
settle(IncrementalPoseGraph& graph)
{
  constexpr int kMostSteps = 10;
  for (int k = 0; k < kMostSteps; ++k)
    if (graph.update().relinearized == 0 && k > 0)
      return;
}

const BetweenFactor&
loopOf(const PoseGraph& graph, FactorId id)
{
  return std::get<BetweenFactor>(graph.factor(id).measurement);
}

/** The loop with its distance from what the other factors say. */
HeldLoop
judged(const IncrementalPoseGraph& graph,
       const BetweenFactor& loop,
       bool in_graph,
       double probability)
{
  JudgedLoop prepared = judgedLoop(graph.graph(), 0, loop, probability);
  prepared.growth =
      stepsBetween(graph.graph(), loop.from, loop.to, in_graph ? &loop : nullptr);
  return {loop,
          jointDistance(graph.graph(),
                        prepared,
                        {graph.covariance({loop.from, loop.to}), in_graph}),
          prepared.limit};
}

} // namespace

LoopGate::LoopGate(double probability) : probability_(probability)
{
  RobustOptions options;
  options.probability = probability;
  options.validate();
}

/** Notes the distance, too. */
bool
LoopGate::agrees(const IncrementalPoseGraph& graph, HeldLoop& held) const
{
  held = judged(graph, held.loop, false, probability_);
  return held.distance <= held.limit;
}

bool
LoopGate::offer(IncrementalPoseGraph& graph, const BetweenFactor& loop)
{
  graph.update();
  HeldLoop candidate{loop, 0.0, 0.0};
  bool is_in = agrees(graph, candidate);
  if (is_in)
    letIn(graph, loop);
  else {
    held_.push_back(candidate);
    const std::vector<std::size_t> confirmed = confirmedWithLast(graph.graph());
    is_in = !confirmed.empty() && letInTogether(graph, confirmed);
  }
  if (is_in)
    tryHeldAgain(graph);
  return is_in;
}

FactorId
LoopGate::letIn(IncrementalPoseGraph& graph, const BetweenFactor& loop)
{
  const FactorId id = graph.addFactor(loop);
  accepted_.insert(id);
  settle(graph);
  return id;
}

void
LoopGate::takeOut(IncrementalPoseGraph& graph, FactorId id)
{
  graph.removeFactor(id);
  accepted_.erase(id);
  settle(graph);
}

void
LoopGate::tryHeldAgain(IncrementalPoseGraph& graph)
{
  const auto agreeing = [&] {
    return std::find_if(held_.begin(), held_.end(), [&](HeldLoop& held) {
      return agrees(graph, held);
    });
  };
  for (auto next = agreeing(); next != held_.end(); next = agreeing()) {
    const BetweenFactor loop = next->loop;
    held_.erase(next);
    letIn(graph, loop);
  }
}

/** Places of the loops that are held and confirm each other and the last one, which is
 * among them; none if the odometry contradicts them more. */
std::vector<std::size_t>
LoopGate::confirmedWithLast(const PoseGraph& graph) const
{
  const OdometryUncertainty odometry(graph, accepted_, {}, true);
  std::vector<MeasuredLoop> loops;
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < held_.size(); ++k)
    if (odometry.motion(held_[k].loop.from, held_[k].loop.to)) {
      loops.push_back(measuredLoop(graph, 0, held_[k].loop));
      places.push_back(k);
    }
  for (const LoopCluster& cluster : clusterLoops(loops, odometry, probability_)) {
    std::vector<std::size_t> confirmed;
    double contradiction = std::numeric_limits<double>::infinity();
    for (const std::size_t k : cluster.members) {
      confirmed.push_back(places[k]);
      contradiction = std::min(contradiction, *cycleDistance(loops[k], odometry));
    }
    if (confirmed.back() + 1 == held_.size() && confirmed.size() > 1 &&
        2.0 * cluster.confirmation >= contradiction)
      return confirmed;
  }
  return {};
}

/** \return whether they stay */
bool
LoopGate::letInTogether(IncrementalPoseGraph& graph,
                        const std::vector<std::size_t>& confirmed)
{
  const std::vector<HeldLoop> before = held_;
  std::vector<FactorId> added;
  for (auto place = confirmed.rbegin(); place != confirmed.rend(); ++place) {
    added.push_back(letIn(graph, held_[*place].loop));
    held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(*place));
  }
  const std::map<FactorId, HeldLoop> gone = takeOutWorst(graph);
  const bool stay = std::none_of(
      added.begin(), added.end(), [&](FactorId id) { return gone.count(id) > 0; });
  if (stay) {
    for (const auto& [id, loop] : gone)
      held_.push_back(loop);
    return true;
  }
  held_ = before;
  for (const FactorId id : added)
    if (accepted_.count(id) > 0)
      takeOut(graph, id);
  for (const auto& [id, loop] : gone)
    if (std::find(added.begin(), added.end(), id) == added.end())
      letIn(graph, loop.loop);
  return false;
}

/** Take out the loop that is farthest from what all others say, until none is farther
 * than the limit. */
std::map<FactorId, HeldLoop>
LoopGate::takeOutWorst(IncrementalPoseGraph& graph)
{
  std::map<FactorId, HeldLoop> gone;
  while (true) {
    std::pair<FactorId, HeldLoop> worst;
    for (const FactorId id : accepted_) {
      const HeldLoop loop =
          judged(graph, loopOf(graph.graph(), id), true, probability_);
      if (loop.distance > std::max(loop.limit, worst.second.distance))
        worst = {id, loop};
    }
    if (worst.second.limit == 0.0)
      return gone;
    takeOut(graph, worst.first);
    gone.insert(worst);
  }
}

} // namespace nurbs
} // namespace pcl
