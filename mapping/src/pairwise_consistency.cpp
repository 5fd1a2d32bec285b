// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "pairwise_consistency.h"

namespace pcl {
namespace nurbs {

bool
rejectByPairs(JudgedGraph& judged,
              const OdometryUncertainty& odometry,
              const RobustOptions& options)
{
  std::vector<JudgedLoop*> loops;
  std::vector<MeasuredLoop> measured;
  for (JudgedLoop& loop : judged.loops)
    if (loop.verdict.accepted) {
      loops.push_back(&loop);
      measured.push_back(loop.measured);
    }
  if (loops.empty())
    return true;
  const NeighbourSets consistent =
      consistentPairs(measured, odometry, loops.front()->limit);
  const MaximumClique clique = maximumClique(consistent, options.max_clique_steps);
  boost::dynamic_bitset<> members(loops.size());
  for (const std::size_t k : clique.vertices)
    members.set(k);
  for (std::size_t k = 0; k < loops.size(); ++k)
    judged.judge(*loops[k],
                 LoopCheck::Pairs,
                 static_cast<double>((consistent[k] & members).count()),
                 static_cast<double>(clique.vertices.size()),
                 members[k]);
  return clique.proven;
}

} // namespace nurbs
} // namespace pcl
