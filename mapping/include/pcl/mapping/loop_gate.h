// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/incremental_pose_graph.h>

#include <map>
#include <set>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A loop that contradicts the graph, and is not part of it.
 * \ingroup mapping */
struct HeldLoop {
  BetweenFactor loop;
  /** Squared Mahalanobis distance from what the graph said when it was judged last. */
  double distance = 0.0;
  double limit = 0.0;
};

/** \brief Lets loops into a growing graph that agree with it, and holds back those that
 * do not: one false loop bends the whole map, a missing one only leaves drift.
 *
 * A loop is judged by its squared Mahalanobis distance from what the graph says about
 * its ends, with the covariance of both. Errors are taken to go all the same way, as
 * drift does: along the shortest way through the graph, n factors, the covariance is n
 * times what it would be if they were independent. Each loop that is let
 * in gives those held before another chance. Loops that are held come in, too, when
 * they confirm each other so well that chance is less likely than an odometry that errs
 * as they say; loops in the graph that then contradict the others most are taken out.
 * If that takes out one of the new ones, all stays as it was.
 *
 * Nodes are to be numbered along the drive; all factors but the loops are trusted.
 * \ingroup mapping */
class PCL_NURBS_MAPPING_EXPORT LoopGate {
public:
  /** \param[in] probability share of true loops that are let in at once, if covariances
   * are right \throws std::invalid_argument if it is not between 0 and 1 */
  explicit LoopGate(double probability = 0.99);

  /** \brief Judge a loop; the graph is up to date afterwards. O(the path to the root of
   * the graph's tree) and the shortest way through the graph where it is
   * let in; where it is not, O(nodes), and where loops
   * that are held confirm each other, such a path for each loop.
   * \return whether it is a factor of the graph now
   * \throws std::invalid_argument if an end is fixed or has no factor */
  bool
  offer(IncrementalPoseGraph& graph, const BetweenFactor& loop);

  /** \brief Factors of the loops that were let in. */
  const std::set<FactorId>&
  accepted() const
  {
    return accepted_;
  }

  const std::vector<HeldLoop>&
  held() const
  {
    return held_;
  }

private:
  bool
  agrees(const IncrementalPoseGraph& graph, HeldLoop& held) const;

  FactorId
  letIn(IncrementalPoseGraph& graph, const BetweenFactor& loop);

  void
  takeOut(IncrementalPoseGraph& graph, FactorId id);

  void
  tryHeldAgain(IncrementalPoseGraph& graph);

  std::vector<std::size_t>
  confirmedWithLast(const PoseGraph& graph) const;

  bool
  letInTogether(IncrementalPoseGraph& graph, const std::vector<std::size_t>& confirmed);

  std::map<FactorId, HeldLoop>
  takeOutWorst(IncrementalPoseGraph& graph);

  double probability_;
  std::set<FactorId> accepted_;
  std::vector<HeldLoop> held_;
};

} // namespace nurbs
} // namespace pcl
