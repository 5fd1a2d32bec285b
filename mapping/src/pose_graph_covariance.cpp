// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pose_graph_covariance.h>

#include "pose_graph_equations.h"

#include <set>
#include <stdexcept>

namespace pcl {
namespace nurbs {

class PoseGraphCovariance::Implementation {
public:
  Implementation(const PoseGraph& graph, PoseGraphCost form)
      : problem(problemOf(graph, form)), equations(problem)
  {
    if (!equations.factor(0.0))
      throw std::invalid_argument("the factors do not determine all poses");
    equations.invert();
  }

  int
  indexFor(NodeId id) const
  {
    return static_cast<int>(indexOf(problem.names, id));
  }

  /** Rows of a pose, though it may be held. */
  Eigen::Index
  sizeOf(int index) const
  {
    return problem.planar[static_cast<std::size_t>(index)] != 0 ? 3 : 6;
  }

  PoseGraphProblem problem;
  PoseGraphEquations equations;
};

PoseGraphCovariance::PoseGraphCovariance(const PoseGraph& graph, PoseGraphCost form)
    : implementation_(std::make_unique<Implementation>(graph, form))
{
}

PoseGraphCovariance::~PoseGraphCovariance() = default;

Eigen::MatrixXd
PoseGraphCovariance::of(const std::vector<NodeId>& ids) const
{
  if (std::set<NodeId>(ids.begin(), ids.end()).size() != ids.size())
    throw std::invalid_argument("a node is asked for twice");
  const Implementation& data = *implementation_;
  std::vector<int> free_poses;
  std::vector<Eigen::Index> rows; // of the result that the free poses fill
  Eigen::Index size = 0;
  for (const NodeId id : ids) {
    const int index = data.indexFor(id);
    if (data.problem.freedom(index) > 0) {
      free_poses.push_back(index);
      for (Eigen::Index k = 0; k < data.sizeOf(index); ++k)
        rows.push_back(size + k);
    }
    size += data.sizeOf(index);
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  if (!rows.empty())
    result(rows, rows) = data.equations.covarianceOf(free_poses);
  return result;
}

} // namespace nurbs
} // namespace pcl
