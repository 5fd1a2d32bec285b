// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph_cost.h>

#include <functional>

namespace pcl {
namespace nurbs {

/** \brief Give a pose to every node that has none, along the between factors from those
 * that have; optimize() begins with it. O(n log n). */
PCL_NURBS_MAPPING_EXPORT void
completeEstimates(PoseGraph& graph);

/** \brief Give every node a pose by going along the between factors from the node of
 * smallest name (or the fixed ones) of each part; consecutive names first, so that
 * odometry is followed where there is some. Fixed nodes stay. O(n log n). */
PCL_NURBS_MAPPING_EXPORT void
initializeFromOdometry(PoseGraph& graph);

/** \brief Give every node a pose by chordal relaxation of the between factors: all
 * rotations by linear least squares, each projected to the nearest rotation, then all
 * translations (Carlone, Tron, Daniilidis, Dellaert, Initialization techniques for 3D
 * SLAM, ICRA 2015, section III-B). Does not depend on estimates, but on fixed nodes,
 * which stay. Two sparse Cholesky factorisations. */
PCL_NURBS_MAPPING_EXPORT void
initializeChordal(PoseGraph& graph, PoseGraphCost form = PoseGraphCost::Information);

/** \brief Give every node that is not fixed a random pose: rotations uniform, positions
 * uniform in a cube as long as all between factors' mean length times the cube root of
 * the number of nodes. The same for the same seed. */
PCL_NURBS_MAPPING_EXPORT void
initializeRandomly(PoseGraph& graph, unsigned seed);

/** \brief Who does the steps; both stop at the same minimum.
 * \ingroup mapping */
enum class PoseGraphMethod {
  Ceres,       /**< Levenberg-Marquardt of Ceres, its sparse normal Cholesky */
  Multifrontal /**< Levenberg-Marquardt on our own clique tree: faster, above all where
                * the BLAS that Ceres finds is slow */
};

/** \brief How a graph is optimised.
 * \ingroup mapping */
struct PoseGraphOptions {
  PoseGraphCost cost = PoseGraphCost::Information;
  PoseGraphMethod method = PoseGraphMethod::Ceres;
  int max_iterations = 200;
  /** Stop when a step lowers the cost by less than this share of it. */
  double function_tolerance = 1e-10;
  int threads = 1; /**< of Ceres' linearisation */
  /** Asked in each iteration; true ends it with what is found so far. */
  std::function<bool()> interrupted;

  /** \throws std::invalid_argument naming what is wrong */
  PCL_NURBS_MAPPING_EXPORT void
  validate() const;
};

/** \brief What optimize() did.
 * \ingroup mapping */
struct PoseGraphSummary {
  double initial_cost = 0.0;
  double final_cost = 0.0;
  int iterations = 0;
  /** The tolerance was reached; false if iterations ran out or it was interrupted. */
  bool converged = false;
  /** Parts that between factors join. */
  std::size_t components = 0;
  /** Nodes held where they are, one for each part that nothing ties to the world. */
  std::vector<NodeId> anchors;
  double seconds = 0.0;
};

/** \brief Move the nodes to a minimum of the cost near their estimates: nonlinear least
 * squares by Ceres on the manifold of poses, with analytic derivatives, sparse Cholesky
 * and nested dissection. Nodes without estimates get them first, by
 * completeEstimates(). A part of the graph
 * without fixed nodes and without factors that tie it to the world keeps the pose of
 * its node of smallest name. Nodes without factors stay.
 * \throws std::invalid_argument for bad options */
PCL_NURBS_MAPPING_EXPORT PoseGraphSummary
optimize(PoseGraph& graph, const PoseGraphOptions& options = {});

} // namespace nurbs
} // namespace pcl
