// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/pose_graph_cost.h>

#include <memory>

namespace pcl {
namespace nurbs {

/** \brief Covariances of a graph's poses at its estimates: the inverse of the Gauss-
 * Newton matrix, held poses being exact.
 *
 * Perturbations are T <- T * exp(tangent), translation before rotation; planar poses
 * have three rows, x, y and the angle. The matrix is factored and inverted within the
 * cliques of its elimination tree once; poses of one factor then cost a look-up, others
 * the paths to the first clique that they have in common. Const members may be
 * called from several threads.
 * \ingroup mapping */
class PCL_NURBS_MAPPING_EXPORT PoseGraphCovariance {
public:
  /** \brief Linearise, factor and invert. The poses that optimize() would hold are
   * held.
   * \throws std::invalid_argument if a node with factors has no estimate, or if the
   * factors do not determine all poses */
  explicit PoseGraphCovariance(const PoseGraph& graph,
                               PoseGraphCost form = PoseGraphCost::Information);

  ~PoseGraphCovariance();

  /** \brief Covariance of some different poses together, in blocks in the order given;
   * zero for held poses.
   * \throws std::out_of_range if a node is not there; std::invalid_argument if one is
   * there twice */
  Eigen::MatrixXd
  of(const std::vector<NodeId>& ids) const;

  /** \brief Of one pose. */
  Eigen::MatrixXd
  of(NodeId id) const
  {
    return of(std::vector<NodeId>{id});
  }

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace nurbs
} // namespace pcl
