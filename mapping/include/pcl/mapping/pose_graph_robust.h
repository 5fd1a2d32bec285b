// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph_solver.h>

#include <cstddef>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief How loops that are false are found.
 * \ingroup mapping */
enum class RobustMethod {
  /** Accept loops one after the other, those first whose ends the odometry knows best,
   * each if it agrees with what odometry and accepted loops say together. False loops
   * never enter a solution, so they neither bend it nor fill its matrices. */
  Consensus,
  /** Graduated non-convexity: weights from a loss that goes from convex to the wanted
   * one while the graph is optimised (Yang, Antonante, Tzoumas, Carlone, RA-L 5(2),
   * 2020). */
  GraduatedNonConvexity,
  /** Switchable constraints in closed form, as dynamic covariance scaling (Agarwal,
   * Tipaldi, Spinello, Stachniss, Burgard, ICRA 2013). */
  Switchable,
  /** The largest set of loops that agree pairwise, given the odometry (Mangelson,
   * Dominic, Eustice, Vasudevan, ICRA 2018). Compares all pairs: O(n^2). */
  PairwiseConsistency
};

/** \brief The loss that graduated non-convexity ends with. */
enum class RobustLoss { TruncatedLeastSquares, GemanMcClure };

/** \brief How optimizeRobustly() tells false loops from true ones. Distances are
 * squared Mahalanobis distances, their limit a quantile of chi square with the degrees
 * of freedom of a pose. */
struct RobustOptions {
  RobustMethod method = RobustMethod::Consensus;
  RobustLoss loss = RobustLoss::TruncatedLeastSquares;
  /** Share of true loops that should pass each check, if covariances are right. */
  double probability = 0.99;
  /** Judge by smaller errors than information matrices say, if the cycles of loops and
   * odometry close better. (Never by larger ones: information that claims too much is
   * to be corrected by the caller.) The solution keeps the information it was given. */
  bool estimate_noise = true;
  /** Before the method: reject loops that contradict the odometry between their ends.
   */
  bool check_cycles = true;
  /** After the method: reject loops that contradict what all others say together, take
   * back rejected ones that agree with it, until nothing changes. Consensus always ends
   * so. */
  bool check_jointly = true;
  /** Ends of graduated non-convexity and of the switchable weights. */
  int max_reweightings = 100;
  int max_joint_rounds = 20;
  /** Branches of the search for the largest consistent set. */
  std::size_t max_clique_steps = 100000;
  PoseGraphOptions solver;

  /** \throws std::invalid_argument naming what is wrong */
  PCL_NURBS_MAPPING_EXPORT void
  validate() const;
};

/** \brief What decided about a loop. */
enum class LoopCheck {
  OdometryCycle, /**< the cycle with the odometry between its ends */
  Pairs,         /**< the largest pairwise consistent set */
  Weight,        /**< the method's weight of it */
  JointDistance  /**< its distance from what all others say */
};

/** \brief Name of a check for reports. */
PCL_NURBS_MAPPING_EXPORT const char*
nameOf(LoopCheck check);

/** \brief What became of a loop. */
struct LoopVerdict {
  FactorId factor = 0;
  bool accepted = true;
  /** The last check that it was subjected to. */
  LoopCheck check = LoopCheck::Weight;
  /** The distance in that check and its limit. (Pairs: members of the consistent set
   * that the loop agrees with, and all members.) */
  double distance = 0.0;
  double limit = 0.0;
};

/** \brief What optimizeRobustly() did. */
struct RobustSummary {
  /** Of the last optimisation, with the accepted loops only; seconds are those of all.
   */
  PoseGraphSummary solution;
  /** All loops that were judged, by name. */
  std::vector<LoopVerdict> loops;
  /** Factors on errors that loops were judged by, at most 1. */
  double translation_scale = 1.0;
  double rotation_scale = 1.0;
  /** Optimisations of the graph. */
  int solutions = 0;
  /** The consistent set is the largest; PairwiseConsistency only. */
  bool clique_proven = true;

  PCL_NURBS_MAPPING_EXPORT std::vector<FactorId>
  accepted() const;

  PCL_NURBS_MAPPING_EXPORT std::vector<FactorId>
  rejected() const;
};

/** \brief Between factors of nodes whose names do not follow each other: the loops of a
 * graph whose nodes are numbered along the drive. */
PCL_NURBS_MAPPING_EXPORT std::vector<FactorId>
loopsOf(const PoseGraph& graph);

/** \brief Optimise a graph some of whose loops may be false, all other factors being
 * trusted. Nodes start from the odometry, i.e. from the trusted factors, whatever their
 * estimates. Rejected loops have weight 0 afterwards, accepted ones weight 1.
 * The same for the same graph and options.
 * \param[in,out] graph a graph that its trusted factors alone hold together
 * \param[in] loops between factors that may be false
 * \throws std::invalid_argument for bad options, or loops that are no between factors;
 * std::out_of_range for loops that are not there */
PCL_NURBS_MAPPING_EXPORT RobustSummary
optimizeRobustly(PoseGraph& graph,
                 const std::vector<FactorId>& loops,
                 const RobustOptions& options = {});

/** \brief The same with loopsOf(graph). */
PCL_NURBS_MAPPING_EXPORT RobustSummary
optimizeRobustly(PoseGraph& graph, const RobustOptions& options = {});

} // namespace nurbs
} // namespace pcl
