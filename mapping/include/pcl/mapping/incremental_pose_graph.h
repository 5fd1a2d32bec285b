// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph_solver.h>

#include <memory>

namespace pcl {
namespace nurbs {

/** \brief How IncrementalPoseGraph estimates.
 * \ingroup mapping */
struct IncrementalOptions {
  PoseGraphCost cost = PoseGraphCost::Information;
  /** A pose is linearised anew when it has turned by more since the last time, radians.
   */
  double relinearize_rotation = 0.01;
  /** Or when it has moved by more, in its own units (metres). */
  double relinearize_translation = 0.1;
  /** Changes below this are not followed down the tree (both units). */
  double solve_threshold = 1e-4;
  /** Gauss-Newton steps of an update at most; there are fewer when no pose has to be
   * linearised anew. */
  int max_steps = 1;

  /** \brief As near to the minimum at each update as it needs to be for a relative
   * difference of the cost far below 1e-6, at two to three times the time. */
  PCL_NURBS_MAPPING_EXPORT static IncrementalOptions
  exact();

  /** \throws std::invalid_argument naming what is wrong */
  PCL_NURBS_MAPPING_EXPORT void
  validate() const;
};

/** \brief What an update did.
 * \ingroup mapping */
struct IncrementalUpdate {
  std::size_t eliminated = 0;   /**< poses eliminated anew, in all steps together */
  std::size_t relinearized = 0; /**< poses whose factors were linearised anew */
  std::size_t solved = 0;       /**< poses whose estimate was computed anew */
  bool all = false;             /**< everything was done anew */
};

/** \brief A pose graph that is estimated while it grows: work per update is in
 * proportion to what new factors touch.
 *
 * The normal equations are kept factored in a tree (iSAM2's Bayes tree: Kaess,
 * Johannsson, Roberts, Ila, Leonard, Dellaert, IJRR 31(2), 2012). A factor changes only
 * the cliques of its nodes and those above them: these are taken apart, put in a new
 * order of elimination with the newest nodes last, and factored, while the rest stays
 * as it is. Poses that have moved far from where their factors were linearised count as
 * changed in the next update. Each update() does one Gauss-Newton step, or a few
 * (IncrementalOptions::exact()); optimizeAll() finds the minimum.
 *
 * \code
 * IncrementalPoseGraph slam;
 * slam.addNode(0, start);
 * for (...) {
 *   slam.addNode(k); // its first pose follows from the first factor
 *   slam.addFactor(BetweenFactor{k - 1, k, motion, information});
 *   slam.update();
 *   use(slam.pose(k));
 * }
 * \endcode
 * Conventions are PoseGraph's. Not to be used from several threads without a lock.
 * \ingroup mapping */
class PCL_NURBS_MAPPING_EXPORT IncrementalPoseGraph {
public:
  /** \throws std::invalid_argument for bad options */
  explicit IncrementalPoseGraph(const IncrementalOptions& options = {});

  /** \brief Begin with a graph, estimated by the next update(). */
  explicit IncrementalPoseGraph(PoseGraph graph,
                                const IncrementalOptions& options = {});

  IncrementalPoseGraph(IncrementalPoseGraph&&) noexcept;
  IncrementalPoseGraph&
  operator=(IncrementalPoseGraph&&) noexcept;
  ~IncrementalPoseGraph();

  /** \brief PoseGraph::addNode(). */
  void
  addNode(NodeId id, bool planar = false);

  /** \brief PoseGraph::addNode(). */
  void
  addNode(NodeId id, const Eigen::Isometry3d& T_world_node, bool planar = false);

  /** \brief PoseGraph::addFactor(); a between factor gives a pose to the node that has
   * none. */
  FactorId
  addFactor(const Measurement& measurement);

  /** \brief PoseGraph::removeFactor(). */
  void
  removeFactor(FactorId id);

  /** \brief PoseGraph::removeNode(). */
  void
  removeNode(NodeId id);

  /** \brief PoseGraph::setWeight(). */
  void
  setWeight(FactorId id, double weight);

  /** \brief PoseGraph::setFixed(); the next update() does everything anew. */
  void
  setFixed(NodeId id, bool fixed);

  /** \brief Bring the estimates up to date with what was added and removed. */
  IncrementalUpdate
  update();

  /** \brief optimize() the whole graph from the present estimates, and go on from
   * there. */
  PoseGraphSummary
  optimizeAll(const PoseGraphOptions& options = {});

  /** \brief The estimate of the last update(), O(log n). \throws std::out_of_range */
  Eigen::Isometry3d
  pose(NodeId id) const;

  /** \brief Covariance of some poses together, in blocks of 6 (planar: 3) in the order
   * given, perturbed as T <- T * exp(tangent), where the factors were linearised last.
   * O(path to the root of the tree).
   * \throws std::out_of_range; std::invalid_argument if a node is held or has no factor
   */
  Eigen::MatrixXd
  covariance(const std::vector<NodeId>& ids) const;

  /** \brief The graph with its nodes at the present estimates. O(nodes moved). */
  const PoseGraph&
  graph() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace nurbs
} // namespace pcl
