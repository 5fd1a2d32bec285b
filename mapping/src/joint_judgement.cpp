// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "joint_judgement.h"

#include "joint_distance.h"
#include "loop_clusters.h"

#include <pcl/mapping/pose_graph_covariance.h>

#include <algorithm>

namespace pcl {
namespace nurbs {
namespace {

using Judged = std::vector<JudgedLoop*>;

std::vector<double>
jointDistances(const JudgedGraph& judged, const Judged& loops, int threads)
{
  const PoseGraphCovariance poses(judged.graph);
  std::vector<double> distances(loops.size());
  const auto count = static_cast<std::ptrdiff_t>(loops.size());
#pragma omp parallel for num_threads(threads) schedule(dynamic, 16)
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    const auto place = static_cast<std::size_t>(k);
    const JudgedLoop& loop = *loops[place];
    distances[place] = jointDistance(
        judged.graph,
        loop,
        {poses.of({loop.measured.from, loop.measured.to}), loop.verdict.accepted});
  }
  return distances;
}

/** Loops that are accepted or rejected together. */
struct Candidates {
  Judged loops;
  /** Of the limit, within which at least half of them must be. */
  double share = 1.0;
};

/** Members are accepted within the limit, if at least half of them agree.
 * \return whether a verdict changed */
bool
judgeTogether(JudgedGraph& judged,
              const Candidates& candidates,
              const double* distances)
{
  const auto agrees = [&](std::size_t k) {
    return distances[k] <= candidates.share * candidates.loops[k]->limit;
  };
  std::size_t agreeing = 0;
  for (std::size_t k = 0; k < candidates.loops.size(); ++k)
    agreeing += agrees(k) ? 1 : 0;
  bool changed = false;
  for (std::size_t k = 0; k < candidates.loops.size(); ++k) {
    JudgedLoop& loop = *candidates.loops[k];
    const bool before = loop.verdict.accepted;
    const bool after = distances[k] <= loop.limit &&
                       (before || 2 * agreeing >= candidates.loops.size());
    if (before || after)
      judged.judge(loop, LoopCheck::JointDistance, distances[k], loop.limit, after);
    changed = changed || before != after;
  }
  return changed;
}

/** \return whether a verdict changed */
bool
judgeJointly(JudgedGraph& judged, const std::vector<Candidates>& queue, int threads)
{
  Judged all;
  for (const Candidates& candidates : queue)
    all.insert(all.end(), candidates.loops.begin(), candidates.loops.end());
  const std::vector<double> distances = jointDistances(judged, all, threads);
  const double* next = distances.data();
  bool changed = false;
  for (const Candidates& candidates : queue) {
    changed = judgeTogether(judged, candidates, next) || changed;
    next += candidates.loops.size();
  }
  return changed;
}

/** Most true loops agree well; of false ones, that lie anywhere, far fewer than within
 * the limit. So one that nothing confirms has to agree well; if not, it has another
 * chance in the end. */
constexpr double kAgreesWell = 0.3;

/** Accepted loops in clusters, the surest first, and their weights set to zero; those
 * that odometry cannot check keep theirs. */
std::vector<Candidates>
queueOf(JudgedGraph& judged, const OdometryUncertainty& odometry, double probability)
{
  Judged loops;
  std::vector<MeasuredLoop> measured;
  for (JudgedLoop& loop : judged.loops)
    if (loop.verdict.accepted && cycleError(loop.measured, odometry)) {
      loops.push_back(&loop);
      measured.push_back(loop.measured);
      judged.judge(loop, LoopCheck::JointDistance, 0.0, loop.limit, false);
    }
  std::vector<Candidates> queue;
  for (const LoopCluster& cluster : clusterLoops(measured, odometry, probability)) {
    queue.push_back({{}, cluster.members.size() > 1 ? 1.0 : kAgreesWell});
    for (const std::size_t k : cluster.members)
      queue.back().loops.push_back(loops[k]);
  }
  return queue;
}

} // namespace

void
growByEvidence(JudgedGraph& judged,
               const OdometryUncertainty& odometry,
               const RobustOptions& options)
{
  const std::vector<Candidates> queue = queueOf(judged, odometry, options.probability);
  judged.solve();
  std::size_t batch = 1;
  std::size_t recent = 0; // the last batch is judged again beside the next one
  for (std::size_t done = 0; done < queue.size(); batch *= 2) {
    const std::size_t end = std::min(queue.size(), done + batch);
    const std::vector<Candidates> next(
        queue.begin() + static_cast<std::ptrdiff_t>(recent),
        queue.begin() + static_cast<std::ptrdiff_t>(end));
    if (judgeJointly(judged, next, options.solver.threads))
      judged.solve();
    recent = done;
    done = end;
  }
}

void
checkJointly(JudgedGraph& judged, const RobustOptions& options)
{
  std::vector<Candidates> all;
  for (JudgedLoop& loop : judged.loops)
    all.push_back({{&loop}, 1.0});
  for (int round = 0; round < options.max_joint_rounds; ++round) {
    // In the second half only rejections, so that it ends.
    if (2 * round >= options.max_joint_rounds)
      for (Candidates& candidates : all)
        candidates.share = -1.0;
    if (!judgeJointly(judged, all, options.solver.threads))
      return;
    judged.solve();
  }
}

} // namespace nurbs
} // namespace pcl
