// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph.h>

namespace pcl {
namespace nurbs {

/** \brief What is minimised.
 * \ingroup mapping */
enum class PoseGraphCost {
  /** Sum of error' * information * error over all factors: chi square, as g2o has it
   * (no factor 1/2). */
  Information,
  /** That of SE-Sync (Rosen, Carlone, Bandeira, Leonard, IJRR 38(2-3), 2019) for
   * between factors: kappa |R_j - R_i R_ij|_F^2 + tau |t_j - t_i - R_i t_ij|^2, with
   * tau = d / trace(C_t) and, in space, kappa = 3 / (2 trace(C_R)), in the plane kappa
   * = 1 / C_R. C_t and C_R are the inverses of the diagonal blocks of the information
   * matrix as a g2o file has it. (There the rotational block belongs to half of the
   * angle in space; that form of the cost takes it for the angle, and so does this
   * one.) Other factors count as in Information. */
  SeSync
};

/** \brief The scalar weights of a between factor in SE-Sync's cost; zero where the
 * information has no inverse. */
struct SeSyncWeights {
  double kappa = 0.0;
  double tau = 0.0;
};

/** \param[in] factor a measurement \param[in] planar its nodes are planar */
PCL_NURBS_MAPPING_EXPORT SeSyncWeights
seSyncWeights(const BetweenFactor& factor, bool planar);

/** \brief Cost at the estimates. O(factors).
 * \throws std::invalid_argument if a node with factors has none */
PCL_NURBS_MAPPING_EXPORT double
costOf(const PoseGraph& graph, PoseGraphCost form = PoseGraphCost::Information);

/** \brief What one factor adds to costOf(): the squared Mahalanobis distance of its
 * error, times its weight. */
PCL_NURBS_MAPPING_EXPORT double
costOf(const PoseGraph& graph,
       FactorId factor,
       PoseGraphCost form = PoseGraphCost::Information);

} // namespace nurbs
} // namespace pcl
