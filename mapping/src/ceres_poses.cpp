// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "ceres_poses.h"

#include <algorithm>

namespace pcl {
namespace nurbs {
namespace {

template <int Rows, int Columns>
using RowMajor = Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>;

using AmbientJacobian = RowMajor<kBlockSize, 6>; // of the ambient space by the tangent
using TangentJacobian = RowMajor<6, kBlockSize>; // and the other way round

/** Twice the change of a quaternion (x y z w) with a turn on its right. */
Eigen::Matrix<double, 4, 3>
turns(const Eigen::Quaterniond& q)
{
  Eigen::Matrix<double, 4, 3> result;
  result.topRows<3>() = q.w() * Eigen::Matrix3d::Identity() + crossMatrix(q.vec());
  result.bottomRows<1>() = -q.vec().transpose();
  return result;
}

AmbientJacobian
plusJacobian(const SolverPose& pose)
{
  AmbientJacobian result = AmbientJacobian::Zero();
  result.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix();
  result.bottomRightCorner<4, 3>() = 0.5 * turns(pose.rotation);
  return result;
}

TangentJacobian
minusJacobian(const SolverPose& pose)
{
  TangentJacobian result = TangentJacobian::Zero();
  result.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix().transpose();
  result.bottomRightCorner<3, 4>() = 2.0 * turns(pose.rotation).transpose();
  return result;
}

} // namespace

PoseBlock
toBlock(const SolverPose& pose)
{
  PoseBlock block;
  Eigen::Map<Eigen::Vector3d>(block.data()) = pose.translation;
  Eigen::Map<Eigen::Vector4d>(block.data() + 3) = pose.rotation.coeffs();
  return block;
}

SolverPose
toPose(const double* block)
{
  SolverPose pose;
  pose.translation = Eigen::Map<const Eigen::Vector3d>(block);
  pose.rotation.coeffs() = Eigen::Map<const Eigen::Vector4d>(block + 3);
  return pose;
}

bool
PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const
{
  Tangent tangent = Tangent::Zero();
  for (int k = 0; k < TangentSize(); ++k)
    tangent(planar_ ? kPlanarRows[static_cast<std::size_t>(k)] : k) = delta[k];
  const PoseBlock moved = toBlock(retract(toPose(x), tangent));
  std::copy(moved.begin(), moved.end(), x_plus_delta);
  return true;
}

bool
PoseManifold::PlusJacobian(const double* x, double* jacobian) const
{
  const AmbientJacobian all = plusJacobian(toPose(x));
  if (!planar_) {
    Eigen::Map<AmbientJacobian> result(jacobian);
    result = all;
    return true;
  }
  Eigen::Map<RowMajor<kBlockSize, 3>> result(jacobian);
  for (int k = 0; k < 3; ++k)
    result.col(k) = all.col(kPlanarRows[static_cast<std::size_t>(k)]);
  return true;
}

bool
PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const
{
  const Tangent tangent = localTangent(toPose(x), toPose(y));
  for (int k = 0; k < TangentSize(); ++k)
    y_minus_x[k] = tangent(planar_ ? kPlanarRows[static_cast<std::size_t>(k)] : k);
  return true;
}

bool
PoseManifold::MinusJacobian(const double* x, double* jacobian) const
{
  const TangentJacobian all = minusJacobian(toPose(x));
  if (!planar_) {
    Eigen::Map<TangentJacobian> result(jacobian);
    result = all;
    return true;
  }
  Eigen::Map<RowMajor<3, kBlockSize>> result(jacobian);
  for (int k = 0; k < 3; ++k)
    result.row(k) = all.row(kPlanarRows[static_cast<std::size_t>(k)]);
  return true;
}

FactorCost::FactorCost(const ProblemFactor& factor,
                       const SolverPose* first,
                       const SolverPose* second)
    : factor_(factor), first_(first), second_(second)
{
  set_num_residuals(factor.rows);
  mutable_parameter_block_sizes()->assign(
      static_cast<std::size_t>((first == nullptr ? 1 : 0) +
                               (second == nullptr ? 1 : 0)),
      kBlockSize);
}

bool
FactorCost::Evaluate(double const* const* parameters,
                     double* residuals,
                     double** jacobians) const
{
  int block = 0;
  const int first_block = first_ == nullptr ? block++ : -1;
  const int second_block = second_ == nullptr ? block : -1;
  const SolverPose first =
      first_ != nullptr ? *first_ : toPose(parameters[first_block]);
  const SolverPose second =
      second_ != nullptr ? *second_ : toPose(parameters[second_block]);
  const auto root = factor_.root.topRows(factor_.rows);
  Eigen::Map<Eigen::VectorXd> result(residuals, factor_.rows);
  if (jacobians == nullptr) {
    result = root * errorOf(factor_.model, first, second);
    return true;
  }
  ErrorValues values;
  linearizeError(factor_.model, first, second, values);
  result = root * values.error;
  const auto write =
      [&](int place, const TangentMatrix& by_tangent, const SolverPose& at) {
        if (place < 0 || jacobians[place] == nullptr)
          return;
        const TangentMatrix whitened = factor_.root * by_tangent;
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, kBlockSize, Eigen::RowMajor>>(
            jacobians[place], factor_.rows, kBlockSize) =
            whitened.topRows(factor_.rows) * minusJacobian(at);
      };
  write(first_block, values.first, first);
  write(second_block, values.second, second);
  return true;
}

} // namespace nurbs
} // namespace pcl
