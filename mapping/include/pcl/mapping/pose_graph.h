// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph_factors.h>

#include <map>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A pose to be estimated.
 * \ingroup mapping */
struct PoseNode {
  /** The estimate, from the node's frame to the world's. */
  Eigen::Isometry3d T_world_node = Eigen::Isometry3d::Identity();
  /** Moves in the plane z = 0 and turns about z only (three degrees of freedom). */
  bool planar = false;
  /** Known: not to be changed. */
  bool fixed = false;
  /** There is an estimate; without, the pose is to be found from the factors. */
  bool has_estimate = true;
  /** Factors on this node, by age. */
  std::vector<FactorId> factors;
};

/** \brief Poses and what was measured about them.
 *
 * The graph holds data and keeps it consistent; optimize(), IncrementalPoseGraph and
 * others estimate. Parts that no factor joins are estimated side by side. Conventions
 * are those of Tangent (perturbations on the right, translation before rotation) and of
 * the factors (pose_graph_factors.h).
 *
 * Const members may be called from several threads.
 *
 * \code
 * PoseGraph graph;
 * graph.addNode(0, Eigen::Isometry3d::Identity());
 * graph.addNode(1);
 * graph.addFactor(BetweenFactor{0, 1, T_0_1, information});
 * optimize(graph);
 * \endcode
 * \ingroup mapping */
class PCL_NURBS_MAPPING_EXPORT PoseGraph {
public:
  using Nodes = std::map<NodeId, PoseNode>;
  using Factors = std::map<FactorId, PoseFactor>;

  /** \brief Add a node whose pose is to be found from factors. O(log n).
   * \throws std::invalid_argument if there is one of that name */
  void
  addNode(NodeId id, bool planar = false);

  /** \brief Add a node with an estimate; the rotation is made orthonormal.
   * \throws std::invalid_argument if there is one of that name, if the pose is no finite
   * rigid motion, or if it is not planar and ought to be */
  void
  addNode(NodeId id, const Eigen::Isometry3d& T_world_node, bool planar = false);

  /** \brief Remove a node and all factors on it.
   * \throws std::out_of_range if there is none of that name */
  void
  removeNode(NodeId id);

  /** \brief Move a node. \throws as addNode(), or std::out_of_range */
  void
  setPose(NodeId id, const Eigen::Isometry3d& T_world_node);

  /** \brief Forget a node's estimate. \throws std::out_of_range */
  void
  clearPose(NodeId id);

  /** \brief Whether estimation leaves the node where it is. \throws std::out_of_range;
   * std::invalid_argument for a node without estimate */
  void
  setFixed(NodeId id, bool fixed);

  /** \brief Add a measurement. O(log n).
   * \return its name; names rise
   * \throws std::out_of_range if a node is not there; std::invalid_argument naming what
   * is wrong with the measurement: not finite, from a node to itself, information not
   * symmetric or not positive semidefinite (to 1e-6 of its largest entry) or all zero
   */
  FactorId
  addFactor(const Measurement& measurement);

  /** \brief Remove a factor. \throws std::out_of_range */
  void
  removeFactor(FactorId id);

  /** \brief Count a factor's information so many times.
   * \throws std::out_of_range; std::invalid_argument if negative or not finite */
  void
  setWeight(FactorId id, double weight);

  /** \brief All nodes by name. */
  const Nodes&
  nodes() const
  {
    return nodes_;
  }

  /** \brief All factors by age. */
  const Factors&
  factors() const
  {
    return factors_;
  }

  bool
  hasNode(NodeId id) const
  {
    return nodes_.count(id) > 0;
  }

  /** \brief One node. \throws std::out_of_range naming it */
  const PoseNode&
  node(NodeId id) const;

  /** \brief One factor. \throws std::out_of_range naming it */
  const PoseFactor&
  factor(FactorId id) const;

  /** \brief Names of the nodes of each part that between factors of positive weight
   * join; the parts by their smallest name. O(n log n). */
  std::vector<std::vector<NodeId>>
  components() const;

private:
  PoseNode&
  nodeToChange(NodeId id);

  Nodes nodes_;
  Factors factors_;
  FactorId next_factor_ = 0;
};

/** \brief The nodes a measurement is about: one or two. */
PCL_NURBS_MAPPING_EXPORT std::vector<NodeId>
nodesOf(const Measurement& measurement);

/** \brief What addFactor() would refuse in the measurement itself.
 * \return a reason, or an empty text if it is valid */
PCL_NURBS_MAPPING_EXPORT std::string
flawOf(const Measurement& measurement);

} // namespace nurbs
} // namespace pcl
