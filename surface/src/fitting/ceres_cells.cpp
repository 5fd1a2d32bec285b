// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "ceres_cells.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

using RowMajorMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/** Residuals R x - d of one cell, padded to a fixed number of rows, and a last one for
 * what no unknown of the cell can explain. */
class CellCost : public ceres::CostFunction {
public:
  /** \param[in] cell equations; may change between evaluations
   * \param[in] column right-hand side
   * \param[in] blocks number of control points of the cell
   * \param[in] channels unknowns of each
   * \param[in] relative whether d is relative to the present unknowns */
  CellCost(
      const TriangularCell& cell, int column, int blocks, int channels, bool relative)
      : cell_(cell), column_(column), channels_(channels), relative_(relative)
  {
    set_num_residuals(blocks * channels + 1);
    mutable_parameter_block_sizes()->assign(static_cast<std::size_t>(blocks), channels);
  }

  bool
  Evaluate(double const* const* parameters,
           double* residuals,
           double** jacobians) const override
  {
    const Eigen::Index rows = cell_.d.rows();
    Eigen::Map<Eigen::VectorXd> result(residuals, num_residuals());
    result.setZero();
    result.head(rows) = -cell_.d.col(column_);
    result(num_residuals() - 1) = std::sqrt(cell_.rest(column_));
    for (int i = 0; rows > 0 && i < static_cast<int>(parameter_block_sizes().size());
         ++i) {
      const auto block = cell_.R.middleCols(i * channels_, channels_);
      if (!relative_)
        result.head(rows) +=
            block * Eigen::Map<const Eigen::VectorXd>(parameters[i], channels_);
    }
    if (jacobians != nullptr)
      fillJacobians(jacobians);
    return result.allFinite();
  }

private:
  void
  fillJacobians(double** jacobians) const
  {
    for (int i = 0; i < static_cast<int>(parameter_block_sizes().size()); ++i) {
      if (jacobians[i] == nullptr)
        continue;
      Eigen::Map<RowMajorMatrix> jacobian(jacobians[i], num_residuals(), channels_);
      jacobian.setZero();
      if (cell_.R.rows() > 0)
        jacobian.topRows(cell_.R.rows()) = cell_.R.middleCols(i * channels_, channels_);
    }
  }

  const TriangularCell& cell_;
  int column_;
  int channels_;
  bool relative_;
};

/** Calls the linearizer once per point that Ceres evaluates. */
class LinearizeCallback : public ceres::EvaluationCallback {
public:
  LinearizeCallback(CellLinearizer& linearizer,
                    const Eigen::MatrixXd& unknowns,
                    std::vector<TriangularCell>& cells)
      : linearizer_(linearizer), unknowns_(unknowns), cells_(cells)
  {
  }

  void
  PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override
  {
    if (new_evaluation_point || (evaluate_jacobians && !has_derivatives_)) {
      linearizer_.linearize(unknowns_, evaluate_jacobians, cells_);
      has_derivatives_ = evaluate_jacobians;
    }
  }

private:
  CellLinearizer& linearizer_;
  const Eigen::MatrixXd& unknowns_;
  std::vector<TriangularCell>& cells_;
  bool has_derivatives_ = false;
};

/** Ends a solve when the cost is as good as zero: relative criteria never would. */
class StopAtCost : public ceres::IterationCallback {
public:
  explicit StopAtCost(double cost) : cost_(cost) {}

  ceres::CallbackReturnType
  operator()(const ceres::IterationSummary& summary) override
  {
    return summary.cost <= cost_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                 : ceres::SOLVER_CONTINUE;
  }

private:
  double cost_;
};

ceres::Solver::Options
solverOptions(const CeresLimits& limits, Eigen::Index unknowns)
{
  ceres::Solver::Options options;
  options.linear_solver_type = unknowns <= limits.dense_unknowns
                                   ? ceres::DENSE_NORMAL_CHOLESKY
                                   : ceres::SPARSE_NORMAL_CHOLESKY;
  options.num_threads = limits.threads;
  options.max_num_iterations = limits.max_iterations;
  options.function_tolerance = limits.function_tolerance;
  options.parameter_tolerance = limits.parameter_tolerance;
  options.logging_type = ceres::SILENT;
  return options;
}

CeresReport
solve(const ceres::Solver::Options& options, ceres::Problem& problem)
{
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  CeresReport report;
  report.usable = summary.IsSolutionUsable();
  report.converged = summary.termination_type == ceres::CONVERGENCE ||
                     summary.termination_type == ceres::USER_SUCCESS;
  report.iterations = static_cast<int>(summary.iterations.size());
  report.initial_cost = summary.initial_cost;
  report.final_cost = summary.final_cost;
  report.message = summary.message;
  return report;
}

/** One residual block per cell and right-hand side, each on its control points. */
void
addCells(const CellPoints& points,
         const std::vector<TriangularCell>& cells,
         int channels,
         bool relative,
         Eigen::MatrixXd& unknowns,
         ceres::Problem& problem)
{
  const int columns = relative ? 1 : static_cast<int>(unknowns.cols());
  for (int cell = 0; cell < points.numCells(); ++cell) {
    const std::vector<int> controls = points.controls(cell);
    for (int column = 0; column < columns; ++column) {
      std::vector<double*> blocks;
      for (int control : controls)
        blocks.push_back(relative ? unknowns.col(control).data()
                                  : &unknowns(control, column));
      problem.AddResidualBlock(new CellCost(cells[static_cast<std::size_t>(cell)],
                                            column,
                                            static_cast<int>(blocks.size()),
                                            channels,
                                            relative),
                               nullptr,
                               blocks);
    }
  }
}

/** Largest gradient entry at the start, to tell what "zero" is for a linear problem. */
double
gradientScale(const std::vector<TriangularCell>& cells)
{
  double scale = 0.0;
  for (const TriangularCell& cell : cells)
    if (cell.d.size() != 0)
      scale = std::max(scale, (cell.R.transpose() * cell.d).cwiseAbs().maxCoeff());
  return scale;
}

} // namespace

CeresReport
solveLinearCells(const CellPoints& points,
                 const std::vector<TriangularCell>& cells,
                 const std::vector<bool>& fixed,
                 const CeresLimits& limits,
                 Eigen::MatrixXd& unknowns)
{
  ceres::Problem problem;
  addCells(points, cells, 1, false, unknowns, problem);
  for (std::size_t i = 0; i < fixed.size(); ++i)
    for (Eigen::Index column = 0; fixed[i] && column < unknowns.cols(); ++column)
      problem.SetParameterBlockConstant(
          &unknowns(static_cast<Eigen::Index>(i), column));

  ceres::Solver::Options options = solverOptions(limits, unknowns.size());
  options.initial_trust_region_radius = 1e16; // the first step is the solution
  options.max_num_iterations = 4;
  options.gradient_tolerance = 1e-11 * gradientScale(cells);
  return solve(options, problem);
}

CeresReport
solveNonlinearCells(const CellPoints& points,
                    CellLinearizer& linearizer,
                    const std::vector<bool>& fixed,
                    const CeresLimits& limits,
                    Eigen::MatrixXd& unknowns)
{
  const int channels = static_cast<int>(unknowns.rows());
  std::vector<TriangularCell> cells(static_cast<std::size_t>(points.numCells()));
  LinearizeCallback callback(linearizer, unknowns, cells);
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &callback;
  ceres::Problem problem(problem_options);
  addCells(points, cells, channels, true, unknowns, problem);
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (fixed[i])
      problem.SetParameterBlockConstant(
          unknowns.col(static_cast<Eigen::Index>(i)).data());

  ceres::Solver::Options options = solverOptions(limits, unknowns.size());
  if (options.linear_solver_type == ceres::DENSE_NORMAL_CHOLESKY)
    options.linear_solver_type = ceres::DENSE_QR; // copes with unknowns that may slide
  StopAtCost stop(limits.negligible_cost);
  options.callbacks.push_back(&stop);
  options.initial_trust_region_radius = limits.trust_radius;
  options.gradient_tolerance = 0.0; // scale-free stopping: by cost and by step only
  return solve(options, problem);
}

} // namespace nurbs
} // namespace pcl
