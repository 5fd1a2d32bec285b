// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "pose_error.h"

#include <pcl/mapping/pose_graph_cost.h>

#include <array>
#include <vector>

namespace pcl {
namespace nurbs {

/** A factor as the solvers see it. */
struct ProblemFactor {
  FactorId id = 0;
  int first = -1; /**< index of the pose, -1 for the world */
  int second = -1;
  ErrorModel model;
  /** The first \a rows rows R of it make |R error|^2 the cost. */
  TangentMatrix root = TangentMatrix::Zero();
  int rows = 0;
};

/** Its cost at two poses. */
double
costOf(const ProblemFactor& factor, const SolverPose& first, const SolverPose& second);

/** A graph with its names replaced by indices: what the solvers work on. */
struct PoseGraphProblem {
  std::vector<NodeId> names; /**< of the poses, rising */
  std::vector<SolverPose> poses;
  std::vector<char> planar;
  std::vector<char> held; /**< fixed, anchors, and poses that no factor is about */
  std::vector<ProblemFactor> factors; /**< of positive weight */
  std::vector<NodeId> anchors;        /**< held for want of a tie to the world */
  std::size_t components = 0;

  /** Pose of a factor's end: the identity for the world. */
  const SolverPose&
  pose(int index) const
  {
    return index < 0 ? world_ : poses[static_cast<std::size_t>(index)];
  }

  /** Degrees of freedom of a pose: 0, 3 or 6. */
  int
  freedom(int index) const
  {
    if (index < 0 || held[static_cast<std::size_t>(index)] != 0)
      return 0;
    return planar[static_cast<std::size_t>(index)] != 0 ? 3 : 6;
  }

  double
  cost() const;

private:
  SolverPose world_;
};

/** Rows of a Tangent that a planar pose moves in: x, y, and about z. */
constexpr std::array<int, 3> kPlanarRows = {0, 1, 5};

/** Place of a name among rising ones. \throws std::out_of_range */
std::size_t
indexOf(const std::vector<NodeId>& names, NodeId id);

/** One factor; its ends have no indices yet. */
ProblemFactor
problemFactorOf(FactorId id,
                const PoseFactor& factor,
                const PoseGraph& graph,
                PoseGraphCost form);

/** \throws std::invalid_argument if a node with factors has no estimate */
PoseGraphProblem
problemOf(const PoseGraph& graph, PoseGraphCost form);

/** Move the graph's nodes that are not held to the problem's poses. */
void
writeBack(const PoseGraphProblem& problem, PoseGraph& graph);

} // namespace nurbs
} // namespace pcl
