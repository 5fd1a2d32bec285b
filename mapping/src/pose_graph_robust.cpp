// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pose_graph_robust.h>
#include <pcl/mapping/stop_watch.h>

#include "joint_distances.h"
#include "loop_reweighting.h"

#include <algorithm>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

class RobustOptimizer {
public:
  RobustOptimizer(PoseGraph& graph,
                  const std::vector<FactorId>& loops,
                  const RobustOptions& options)
      : graph_(graph), options_(options), odometry_(graph, {loops.begin(), loops.end()})
  {
    const std::set<FactorId> once(loops.begin(), loops.end());
    for (const FactorId id : once) {
      loops_.push_back(judgedLoop(graph, id, options.probability));
      JudgedLoop& loop = loops_.back();
      loop.factor.first = node(loop.measured.from);
      loop.factor.second = node(loop.measured.to);
      graph.setWeight(id, 1.0);
    }
    initializeFromOdometry(graph);
  }

  RobustSummary
  run()
  {
    StopWatch watch;
    if (options_.estimate_noise)
      lowerLimits();
    if (options_.check_cycles)
      checkCycles();
    applyMethod();
    solve(options_.solver);
    if (options_.check_jointly)
      checkJointly();
    for (const JudgedLoop& loop : loops_)
      summary_.loops.push_back(loop.verdict);
    summary_.solution.seconds = watch.lap();
    return summary_;
  }

private:
  int
  node(NodeId id) const
  {
    return static_cast<int>(odometry_.indexOf(id));
  }

  void
  judge(JudgedLoop& loop, LoopCheck check, double distance, double limit, bool accepted)
  {
    loop.verdict = {loop.factor.id, accepted, check, distance, limit};
    graph_.setWeight(loop.factor.id, accepted ? 1.0 : 0.0);
  }

  void
  solve(const PoseGraphOptions& options)
  {
    summary_.solution = optimize(graph_, options);
    ++summary_.solutions;
  }

  /** By the lower quartile of the cycles' distances, which false loops hardly touch as
   * long as they are no more than the true ones. */
  void
  lowerLimits()
  {
    constexpr double kShare = 0.25;
    constexpr std::size_t kFewest = 20;
    std::vector<double> ratios;
    for (const JudgedLoop& loop : loops_)
      if (const auto distance = cycleDistance(loop.measured, odometry_))
        ratios.push_back(*distance /
                         chiSquareQuantile(freedomOf(loop.measured), kShare));
    if (ratios.size() < kFewest)
      return;
    const auto place =
        ratios.begin() +
        static_cast<std::ptrdiff_t>(kShare * static_cast<double>(ratios.size()));
    std::nth_element(ratios.begin(), place, ratios.end());
    summary_.noise_scale = std::min(1.0, *place);
    for (JudgedLoop& loop : loops_)
      loop.limit *= summary_.noise_scale;
  }

  void
  checkCycles()
  {
    for (JudgedLoop& loop : loops_)
      if (const auto distance = cycleDistance(loop.measured, odometry_))
        judge(loop,
              LoopCheck::OdometryCycle,
              *distance,
              loop.limit,
              *distance <= loop.limit);
  }

  void
  applyMethod()
  {
    PoseGraphOptions quick = options_.solver;
    constexpr double kCoarse = 1e-4;
    quick.function_tolerance = std::max(kCoarse, quick.function_tolerance);
    const GraphSolver solver = [&] { solve(quick); };
    switch (options_.method) {
    case RobustMethod::GraduatedNonConvexity:
      return rejectByGraduatedNonConvexity(graph_, loops_, options_, solver);
    case RobustMethod::Switchable:
      return rejectBySwitches(graph_, loops_, options_, solver);
    case RobustMethod::PairwiseConsistency:
      return rejectByPairs();
    }
  }

  void
  rejectByPairs()
  {
    std::vector<JudgedLoop*> judged;
    std::vector<MeasuredLoop> measured;
    for (JudgedLoop& loop : loops_)
      if (loop.verdict.accepted) {
        judged.push_back(&loop);
        measured.push_back(loop.measured);
      }
    if (judged.empty())
      return;
    const NeighbourSets consistent =
        consistentPairs(measured, odometry_, judged.front()->limit);
    const Clique clique = maximumClique(consistent, options_.max_clique_steps);
    summary_.clique_proven = clique.proven;
    boost::dynamic_bitset<> members(judged.size());
    for (const std::size_t k : clique.vertices)
      members.set(k);
    for (std::size_t k = 0; k < judged.size(); ++k)
      judge(*judged[k],
            LoopCheck::Pairs,
            static_cast<double>((consistent[k] & members).count()),
            static_cast<double>(clique.vertices.size()),
            members[k]);
  }

  /** \return whether a verdict changed */
  bool
  judgeJointly(bool may_accept)
  {
    const JointDistances joint(graph_);
    bool changed = false;
    for (JudgedLoop& loop : loops_) {
      const bool before = loop.verdict.accepted;
      const double distance = joint.squaredDistance(loop.factor, before);
      const bool after = distance <= loop.limit && (before || may_accept);
      judge(loop, LoopCheck::JointDistance, distance, loop.limit, after);
      changed = changed || before != after;
    }
    return changed;
  }

  void
  checkJointly()
  {
    for (int round = 0; round < options_.max_joint_rounds; ++round) {
      // In the second half only rejections, so that it ends.
      if (!judgeJointly(2 * round < options_.max_joint_rounds))
        return;
      solve(options_.solver);
    }
  }

  PoseGraph& graph_;
  const RobustOptions& options_;
  OdometryUncertainty odometry_;
  std::vector<JudgedLoop> loops_;
  RobustSummary summary_;
};

std::vector<FactorId>
namesOf(const std::vector<LoopVerdict>& loops, bool accepted)
{
  std::vector<FactorId> names;
  for (const LoopVerdict& loop : loops)
    if (loop.accepted == accepted)
      names.push_back(loop.factor);
  return names;
}

} // namespace

void
RobustOptions::validate() const
{
  if (!(probability > 0.0 && probability < 1.0))
    throw std::invalid_argument("the probability must be between 0 and 1");
  if (max_reweightings < 1)
    throw std::invalid_argument("the number of reweightings must be positive");
  if (max_joint_rounds < 1)
    throw std::invalid_argument("the number of joint rounds must be positive");
  if (max_clique_steps < 1)
    throw std::invalid_argument("the number of clique steps must be positive");
  solver.validate();
}

const char*
nameOf(LoopCheck check)
{
  switch (check) {
  case LoopCheck::OdometryCycle:
    return "odometry_cycle";
  case LoopCheck::Pairs:
    return "pairs";
  case LoopCheck::Weight:
    return "weight";
  case LoopCheck::JointDistance:
    return "joint_distance";
  }
  throw std::invalid_argument("no check of a loop");
}

std::vector<FactorId>
RobustSummary::accepted() const
{
  return namesOf(loops, true);
}

std::vector<FactorId>
RobustSummary::rejected() const
{
  return namesOf(loops, false);
}

std::vector<FactorId>
loopsOf(const PoseGraph& graph)
{
  std::vector<FactorId> loops;
  for (const auto& [id, factor] : graph.factors())
    if (const auto* between = std::get_if<BetweenFactor>(&factor.measurement))
      if (std::max(between->from, between->to) - std::min(between->from, between->to) > 1)
        loops.push_back(id);
  return loops;
}

RobustSummary
optimizeRobustly(PoseGraph& graph,
                 const std::vector<FactorId>& loops,
                 const RobustOptions& options)
{
  options.validate();
  return RobustOptimizer(graph, loops, options).run();
}

RobustSummary
optimizeRobustly(PoseGraph& graph, const RobustOptions& options)
{
  return optimizeRobustly(graph, loopsOf(graph), options);
}

} // namespace nurbs
} // namespace pcl
