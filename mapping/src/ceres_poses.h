// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "pose_graph_problem.h"

#include <ceres/cost_function.h>
#include <ceres/manifold.h>

#include <array>

namespace pcl {
namespace nurbs {

constexpr int kBlockSize = 7;

/** A pose as Ceres' parameters: translation, then the quaternion as x y z w. */
using PoseBlock = std::array<double, kBlockSize>;

PoseBlock
toBlock(const SolverPose& pose);

SolverPose
toPose(const double* block);

/** The manifold of poses with retract() as Plus; planar ones have the three tangents of
 * kPlanarRows. */
class PoseManifold : public ceres::Manifold {
public:
  explicit PoseManifold(bool planar) : planar_(planar) {}

  int
  AmbientSize() const override
  {
    return kBlockSize;
  }

  int
  TangentSize() const override
  {
    return planar_ ? 3 : 6;
  }

  bool
  Plus(const double* x, const double* delta, double* x_plus_delta) const override;

  bool
  PlusJacobian(const double* x, double* jacobian) const override;

  bool
  Minus(const double* y, const double* x, double* y_minus_x) const override;

  bool
  MinusJacobian(const double* x, double* jacobian) const override;

private:
  bool planar_;
};

/** A factor as Ceres' residuals, its rows times the error. */
class FactorCost : public ceres::CostFunction {
public:
  /** \param[in] factor must outlive this \param[in] first pose of its first end if that
   * is held, else null: it is then the first parameter block \param[in] second the same
   * of its second end */
  FactorCost(const ProblemFactor& factor,
             const SolverPose* first,
             const SolverPose* second);

  bool
  Evaluate(double const* const* parameters,
           double* residuals,
           double** jacobians) const override;

private:
  const ProblemFactor& factor_;
  const SolverPose* first_;
  const SolverPose* second_;
};

} // namespace nurbs
} // namespace pcl
