// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/pose_graph_solver.h>

#include "ceres_poses.h"
#include "elimination_order.h"
#include "pose_graph_equations.h"
#include "pose_graph_problem.h"

#include <pcl/mapping/stop_watch.h>

#include <ceres/iteration_callback.h>
#include <ceres/ordered_groups.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

class StopOnRequest : public ceres::IterationCallback {
public:
  explicit StopOnRequest(const std::function<bool()>& requested) : requested_(requested)
  {
  }

  ceres::CallbackReturnType
  operator()(const ceres::IterationSummary&) override
  {
    return requested_ ? (requested_() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                      : ceres::SOLVER_CONTINUE)
                      : ceres::SOLVER_CONTINUE;
  }

private:
  const std::function<bool()>& requested_;
};

/** The problem's poses as Ceres' parameters, and its factors as residuals. */
class CeresProblem {
public:
  explicit CeresProblem(const PoseGraphProblem& problem) : source_(problem)
  {
    blocks_.reserve(problem.poses.size());
    for (const SolverPose& pose : problem.poses)
      blocks_.push_back(toBlock(pose));
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    problem_ = std::make_unique<ceres::Problem>(options);
    for (std::size_t k = 0; k < blocks_.size(); ++k)
      addPose(k);
    for (const ProblemFactor& factor : problem.factors)
      addFactor(factor);
  }

  ceres::Problem&
  problem()
  {
    return *problem_;
  }

  /** Eliminate in this order. */
  std::shared_ptr<ceres::ParameterBlockOrdering>
  ordering(const std::vector<int>& order)
  {
    auto result = std::make_shared<ceres::ParameterBlockOrdering>();
    int place = 0;
    for (const int k : order)
      result->AddElementToGroup(block(k), place++);
    return result;
  }

  void
  writeTo(PoseGraphProblem& problem) const
  {
    for (std::size_t k = 0; k < blocks_.size(); ++k)
      if (problem.held[k] == 0)
        problem.poses[k] = toPose(blocks_[k].data());
  }

private:
  double*
  block(int index)
  {
    return blocks_[static_cast<std::size_t>(index)].data();
  }

  void
  addPose(std::size_t k)
  {
    if (source_.held[k] != 0)
      return;
    ceres::Manifold* manifold = &space_;
    if (source_.planar[k] != 0)
      manifold = &plane_;
    problem_->AddParameterBlock(blocks_[k].data(), kBlockSize, manifold);
  }

  void
  addFactor(const ProblemFactor& factor)
  {
    const bool first = source_.freedom(factor.first) > 0;
    const bool second = source_.freedom(factor.second) > 0;
    if (!first && !second)
      return;
    std::vector<double*> blocks;
    if (first)
      blocks.push_back(block(factor.first));
    if (second)
      blocks.push_back(block(factor.second));
    problem_->AddResidualBlock(
        new FactorCost(factor,
                       first ? nullptr : &source_.pose(factor.first),
                       second ? nullptr : &source_.pose(factor.second)),
        nullptr,
        blocks);
  }

  const PoseGraphProblem& source_;
  std::vector<PoseBlock> blocks_;
  PoseManifold space_{false};
  PoseManifold plane_{true};
  std::unique_ptr<ceres::Problem> problem_;
};

ceres::Solver::Options
solverOptions(const PoseGraphOptions& options)
{
  ceres::Solver::Options result;
  result.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  result.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  result.max_num_iterations = options.max_iterations;
  result.function_tolerance = options.function_tolerance;
  result.gradient_tolerance = 0.0;
  result.parameter_tolerance = 1e-13; // where residuals vanish, nothing else ends it
  result.max_num_consecutive_invalid_steps = 50;
  result.initial_trust_region_radius = 1e8; // starts are good: nearly Gauss-Newton
  result.max_trust_region_radius = 1e32;
  result.num_threads = options.threads;
  result.logging_type = ceres::SILENT;
  return result;
}

void
solveByCeres(PoseGraphProblem& problem,
             const PoseGraphOptions& options,
             PoseGraphSummary& summary)
{
  CeresProblem ceres_problem(problem);
  StopOnRequest stop(options.interrupted);
  ceres::Solver::Options settings = solverOptions(options);
  settings.callbacks.push_back(&stop);
  settings.linear_solver_ordering = ceres_problem.ordering(eliminationOrder(problem));
  ceres::Solver::Summary result;
  ceres::Solve(settings, &ceres_problem.problem(), &result);
  ceres_problem.writeTo(problem);
  summary.iterations = static_cast<int>(result.iterations.size()) - 1;
  summary.converged = result.termination_type == ceres::CONVERGENCE;
}

} // namespace

void
PoseGraphOptions::validate() const
{
  if (max_iterations < 0)
    throw std::invalid_argument("the number of iterations must not be negative");
  if (!(function_tolerance > 0.0))
    throw std::invalid_argument("the tolerance of the cost must be positive");
  if (threads < 1)
    throw std::invalid_argument("the number of threads must be positive");
}

PoseGraphSummary
optimize(PoseGraph& graph, const PoseGraphOptions& options)
{
  options.validate();
  StopWatch watch;
  completeEstimates(graph);
  PoseGraphProblem problem = problemOf(graph, options.cost);
  PoseGraphSummary summary;
  summary.components = problem.components;
  summary.anchors = problem.anchors;
  summary.initial_cost = problem.cost();
  if (options.method == PoseGraphMethod::Ceres)
    solveByCeres(problem, options, summary);
  else
    PoseGraphEquations(problem).minimize(options, summary);
  summary.final_cost = problem.cost();
  writeBack(problem, graph);
  summary.seconds = watch.lap();
  return summary;
}

} // namespace nurbs
} // namespace pcl
