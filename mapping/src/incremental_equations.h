// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "clique_tree.h"
#include "pose_graph_problem.h"

#include <pcl/mapping/incremental_pose_graph.h>

#include <unordered_map>
#include <unordered_set>

namespace pcl {
namespace nurbs {

/** The factored equations of a growing graph: its nodes with factors as variables, its
 * factors as terms, and what makes the solution unique.
 *
 * A part of the graph that nothing ties to the world has an anchor: a prior on one of
 * its nodes, so strong that it hardly gives way. It goes when the part is joined to
 * another one or tied down. */
class IncrementalEquations {
public:
  IncrementalEquations(const PoseGraph& graph, PoseGraphCost form);

  /** Take in a factor of the graph; does nothing if its weight is zero. */
  void
  addFactor(FactorId id);

  /** Forget a factor; it is still in the graph. */
  void
  removeFactor(FactorId id);

  /** Linearise the poses that have moved by more than the options say anew, factor what
   * has changed and solve. */
  IncrementalUpdate
  update(const IncrementalOptions& options);

  /** Begin anew with all factors and the poses of the graph. */
  IncrementalUpdate
  rebuild();

  /** Whether a node is a variable. */
  bool
  has(NodeId id) const
  {
    return variable_of_.count(id) > 0;
  }

  /** The estimate of a node that is a variable. */
  SolverPose
  pose(NodeId id) const;

  /** Nodes whose estimate has changed since the last call. */
  std::vector<NodeId>
  takeMoved();

  Eigen::MatrixXd
  covariance(const std::vector<NodeId>& ids) const;

private:
  struct Variable {
    NodeId id = 0;
    SolverPose pose; /**< where its factors are linearised */
    bool planar = false;
    double scale = 0.0; /**< largest entry of the information of its first factor */
    int factors = 0;
    int part = -1;     /**< any variable of its part of the graph, nearer to the root */
    int anchor = -1;   /**< term, at the root of its part */
    bool tied = false; /**< its part, at the root */
    int damping = -1;  /**< term */
  };

  struct Term {
    ProblemFactor factor;
    int first = -1; /**< variable, -1: held or none */
    int second = -1;
    SolverPose first_pose; /**< if held */
    SolverPose second_pose;
    bool is_damping = false;
  };

  int
  variableFor(NodeId id, const ProblemFactor& factor);

  int
  addTerm(Term term);

  void
  removeTerm(int term);

  void
  setAnchor(int variable);

  void
  dropAnchor(int part);

  int
  partOf(int variable);

  void
  join(int a, int b);

  void
  tie(int variable);

  void
  findParts();

  void
  dropVariable(int variable);

  void
  assemble(int term, FrontView& front) const;

  bool
  solveAll();

  void
  noteMoved(const IncrementalOptions& options);

  Tangent
  stepOf(int variable) const;

  Variable&
  at(int variable)
  {
    return variables_[static_cast<std::size_t>(variable)];
  }

  const Variable&
  at(int variable) const
  {
    return variables_[static_cast<std::size_t>(variable)];
  }

  const PoseGraph& graph_;
  PoseGraphCost form_;
  std::unique_ptr<CliqueTree> tree_;
  std::vector<Variable> variables_;
  std::vector<Term> terms_;
  std::unordered_map<NodeId, int> variable_of_;
  std::unordered_map<FactorId, int> term_of_;
  std::vector<int> changed_;    // variables with terms that are new or gone
  std::unordered_set<int> far_; // from where they are linearised
  std::unordered_set<NodeId> moved_;
  double damping_ = 0.0; // share of the scale
  bool parts_are_old_ = false;
};

} // namespace nurbs
} // namespace pcl
