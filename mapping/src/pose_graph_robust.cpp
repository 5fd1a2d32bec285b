// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pose_graph_robust.h>
#include <pcl/mapping/stop_watch.h>

#include "joint_judgement.h"
#include "loop_reweighting.h"
#include "noise_scale.h"
#include "pairwise_consistency.h"

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
      : graph_(graph), options_(options), names_(loops.begin(), loops.end())
  {
    for (const FactorId id : names_)
      if (!std::holds_alternative<BetweenFactor>(graph.factor(id).measurement))
        throw std::invalid_argument("factor " + std::to_string(id) +
                                    " is no between factor, so it is no loop");
  }

  RobustSummary
  run()
  {
    StopWatch watch;
    NoiseScale scale;
    if (options_.estimate_noise)
      scale = estimateNoiseScale(graph_, names_);
    summary_.translation_scale = scale.translation;
    summary_.rotation_scale = scale.rotation;
    judged_ = judgedGraph(graph_, names_, scale, options_.probability);
    initializeFromOdometry(judged_.graph);
    judgeAll(OdometryUncertainty(graph_, names_, scale));
    adopt();
    summary_.solution = optimize(graph_, options_.solver);
    summary_.solution.seconds = watch.lap();
    return summary_;
  }

private:
  void
  judgeAll(const OdometryUncertainty& odometry)
  {
    solveWith(1e-4);
    if (options_.check_cycles)
      checkCycles(odometry);
    applyMethod(odometry);
    if (!options_.check_jointly && options_.method != RobustMethod::Consensus)
      return;
    solveWith(1e-8);
    judged_.solve();
    checkJointly(judged_, options_);
  }

  /** From now on, until a step lowers the cost by less than this share. */
  void
  solveWith(double tolerance)
  {
    judged_.solve = [this, tolerance] {
      PoseGraphOptions options = options_.solver;
      options.cost = PoseGraphCost::Information;
      options.method = PoseGraphMethod::Multifrontal;
      options.function_tolerance = std::max(tolerance, options.function_tolerance);
      takeBetterStart();
      optimize(judged_.graph, options);
      ++summary_.solutions;
    };
  }

  /** Poses that loops have bent which are rejected by now may not find back by steps:
   * begin where the accepted loops alone lead if they are nearer to their minimum. */
  void
  takeBetterStart()
  {
    PoseGraph chordal = judged_.graph;
    initializeChordal(chordal);
    if (costOf(chordal) < costOf(judged_.graph))
      judged_.graph = std::move(chordal);
  }

  void
  checkCycles(const OdometryUncertainty& odometry)
  {
    for (JudgedLoop& loop : judged_.loops)
      if (const auto distance = cycleDistance(loop.measured, odometry))
        judged_.judge(loop,
                      LoopCheck::OdometryCycle,
                      *distance,
                      loop.limit,
                      *distance <= loop.limit);
  }

  void
  applyMethod(const OdometryUncertainty& odometry)
  {
    switch (options_.method) {
    case RobustMethod::Consensus:
      return growByEvidence(judged_, odometry, options_);
    case RobustMethod::GraduatedNonConvexity:
      return rejectByGraduatedNonConvexity(judged_, options_);
    case RobustMethod::Switchable:
      return rejectBySwitches(judged_, options_);
    case RobustMethod::PairwiseConsistency:
      summary_.clique_proven = rejectByPairs(judged_, odometry, options_);
      return;
    }
  }

  /** Take verdicts and poses over to the graph. */
  void
  adopt()
  {
    for (const JudgedLoop& loop : judged_.loops) {
      graph_.setWeight(loop.verdict.factor, loop.verdict.accepted ? 1.0 : 0.0);
      summary_.loops.push_back(loop.verdict);
    }
    for (const auto& [id, node] : judged_.graph.nodes())
      if (!node.fixed && node.has_estimate)
        graph_.setPose(id, node.T_world_node);
  }

  PoseGraph& graph_;
  const RobustOptions& options_;
  std::set<FactorId> names_;
  JudgedGraph judged_;
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
      if (std::max(between->from, between->to) - std::min(between->from, between->to) >
          1)
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
