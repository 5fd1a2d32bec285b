// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "joint_judgement.h"

#include "joint_distance.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

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
    distances[place] = jointDistance(judged.graph, poses, loop, loop.verdict.accepted);
  }
  return distances;
}

/** \param[in] share of the limit within which a loop is accepted that was not
 * \return whether a verdict changed */
bool
judgeJointly(JudgedGraph& judged, const Judged& loops, double share, int threads)
{
  const std::vector<double> distances = jointDistances(judged, loops, threads);
  bool changed = false;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    JudgedLoop& loop = *loops[k];
    const bool before = loop.verdict.accepted;
    const bool after = distances[k] <= (before ? 1.0 : share) * loop.limit;
    if (before || after)
      judged.judge(loop, LoopCheck::JointDistance, distances[k], loop.limit, after);
    changed = changed || before != after;
  }
  return changed;
}

double
logDeterminant(const TangentMatrix& covariance, bool planar)
{
  return planar ? std::log(planarPart(covariance).determinant())
                : std::log(covariance.determinant());
}

/** How much wider the odometry's knowledge of where a loop leads is than the loop's
 * measurement: twice the logarithm of the ratio of the volumes. */
double
vagueness(const MeasuredLoop& loop, const CycleError& cycle)
{
  return logDeterminant(cycle.covariance, loop.planar) -
         logDeterminant(loop.measured.covariance, loop.planar);
}

/** Loops that are accepted, the best known first, and their weights set to zero; those
 * that odometry cannot check keep theirs. */
Judged
queueOf(JudgedGraph& judged, const OdometryUncertainty& odometry)
{
  std::vector<std::pair<double, JudgedLoop*>> order;
  for (JudgedLoop& loop : judged.loops) {
    const auto cycle = cycleError(loop.measured, odometry);
    if (!loop.verdict.accepted || !cycle)
      continue;
    order.emplace_back(vagueness(loop.measured, *cycle), &loop);
    judged.judge(loop, LoopCheck::JointDistance, 0.0, loop.limit, false);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return a.first < b.first;
  });
  Judged queue;
  for (const auto& [value, loop] : order)
    queue.push_back(loop);
  return queue;
}

} // namespace

void
growByCertainty(JudgedGraph& judged,
                const OdometryUncertainty& odometry,
                const RobustOptions& options)
{
  const Judged queue = queueOf(judged, odometry);
  judged.solve();
  std::size_t batch = 10;
  std::size_t done = 0;
  std::size_t recent = 0; // the last batch is judged again beside the next one
  while (done < queue.size()) {
    const std::size_t end = std::min(queue.size(), done + batch);
    const Judged next(queue.begin() + static_cast<std::ptrdiff_t>(recent),
                      queue.begin() + static_cast<std::ptrdiff_t>(end));
    // Most true loops agree well; of false ones, that lie anywhere, far fewer than
    // within the limit. The others have their chance in the end.
    constexpr double kAgreesWell = 0.3;
    if (judgeJointly(judged, next, kAgreesWell, options.solver.threads))
      judged.solve();
    recent = done;
    done = end;
    batch *= 2;
  }
}

void
checkJointly(JudgedGraph& judged, const RobustOptions& options)
{
  Judged all;
  for (JudgedLoop& loop : judged.loops)
    all.push_back(&loop);
  for (int round = 0; round < options.max_joint_rounds; ++round) {
    // In the second half only rejections, so that it ends.
    const double share = 2 * round < options.max_joint_rounds ? 1.0 : -1.0;
    if (!judgeJointly(judged, all, share, options.solver.threads))
      return;
    judged.solve();
  }
}

} // namespace nurbs
} // namespace pcl
