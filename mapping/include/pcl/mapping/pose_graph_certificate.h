// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph_solver.h>

#include <string>

namespace pcl {
namespace nurbs {

/** \brief A bound below the cost of all poses a graph could have.
 * \ingroup mapping */
struct OptimalityCertificate {
  /** Whether there is a bound; else why not. */
  bool available = false;
  std::string reason;
  double cost = 0.0;
  /** No poses cost less. */
  double lower_bound = 0.0;

  /** \brief The estimate is the best one, to this share of its cost (and, where the
   * cost is nearly zero, to rounding). */
  bool
  certifies(double share = 1e-5) const
  {
    return available && cost - lower_bound <= share * cost + rounding;
  }

  /** Error of the bound by rounding. */
  double rounding = 0.0;
};

/** \brief Bound a graph's cost from below by the dual of its semidefinite relaxation
 * (SE-Sync: Rosen, Carlone, Bandeira, Leonard, IJRR 38(2-3), 2019, theorem 7; Briales,
 * Gonzalez-Jimenez, Fast global optimality verification in 3D SLAM, IROS 2016).
 *
 * With Lambda from the stationarity of the estimate, F >= trace(Lambda) - d n eps for
 * all poses if the quadratic form of the cost minus Lambda plus eps is positive
 * semidefinite, which a sparse Cholesky factorisation tells. The bound holds for every
 * estimate and is tight at the best one unless the noise is extreme.
 *
 * There is a bound for between factors with isotropic information (always so in
 * PoseGraphCost::SeSync; in Information, in space only), if there are no other factors
 * and no part of the graph has two fixed nodes.
 * \param[in] graph with estimates \param[in] form which cost
 * \throws std::invalid_argument if a node with factors has no estimate */
PCL_NURBS_MAPPING_EXPORT OptimalityCertificate
certify(const PoseGraph& graph, PoseGraphCost form = PoseGraphCost::Information);

/** \brief What optimizeFromBestStart() did. */
struct GlobalSummary {
  PoseGraphSummary summary; /**< of the run whose result was kept */
  OptimalityCertificate certificate;
  double given_cost = 0.0;   /**< at the estimates that were given */
  double chordal_cost = 0.0; /**< at those of initializeChordal() */
  bool from_chordal = false; /**< the result began there */
  double seconds = 0.0;
};

/** \brief optimize() from the estimates or from initializeChordal(), whichever costs
 * less, certify(), and where there is no certificate try the other start too and keep
 * the better result. */
PCL_NURBS_MAPPING_EXPORT GlobalSummary
optimizeFromBestStart(PoseGraph& graph, const PoseGraphOptions& options = {});

} // namespace nurbs
} // namespace pcl
