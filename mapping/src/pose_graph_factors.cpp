// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "factor_models.h"

#include <pcl/mapping/pose_graph.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

bool
isRigid(const Eigen::Isometry3d& pose)
{
  constexpr double kMostOff = 1e-6;
  const Eigen::Matrix3d rotation = pose.linear();
  return pose.matrix().allFinite() &&
         (rotation * rotation.transpose()).isIdentity(kMostOff) &&
         rotation.determinant() > 0.0;
}

template <typename Matrix>
std::string
flawOfInformation(const Matrix& information)
{
  constexpr double kRounding = 1e-6; // files have about 6 digits
  if (!information.allFinite())
    return "the information matrix is not finite";
  const double largest = information.cwiseAbs().maxCoeff();
  if (largest == 0.0)
    return "the information matrix is zero";
  if ((information - information.transpose()).cwiseAbs().maxCoeff() >
      kRounding * largest)
    return "the information matrix is not symmetric";
  const Eigen::SelfAdjointEigenSolver<Matrix> values(information / largest,
                                                     Eigen::EigenvaluesOnly);
  if (values.eigenvalues()(0) < -kRounding)
    return "the information matrix is not positive semidefinite";
  return {};
}

std::string
flawOfDirections(const DirectionFactor& factor)
{
  constexpr double kMostOff = 1e-3;
  for (const Eigen::Vector3d& direction :
       {factor.direction_world, factor.direction_node})
    if (!(std::abs(direction.norm() - 1.0) <= kMostOff))
      return "a direction is not of unit length";
  return {};
}

struct FlawFinder {
  std::string
  operator()(const BetweenFactor& factor) const
  {
    if (factor.from == factor.to)
      return "it joins node " + std::to_string(factor.from) + " to itself";
    if (!isRigid(factor.T_from_to))
      return "the measured pose is no rigid motion";
    return flawOfInformation(factor.information);
  }

  std::string
  operator()(const PriorFactor& factor) const
  {
    if (!isRigid(factor.T_world_node))
      return "the measured pose is no rigid motion";
    return flawOfInformation(factor.information);
  }

  std::string
  operator()(const PositionFactor& factor) const
  {
    if (!factor.point_world.allFinite() || !factor.point_node.allFinite())
      return "the measured position is not finite";
    return flawOfInformation(factor.information);
  }

  std::string
  operator()(const DirectionFactor& factor) const
  {
    const std::string flaw = flawOfDirections(factor);
    return flaw.empty() ? flawOfInformation(factor.information) : flaw;
  }
};

struct NodeLister {
  std::vector<NodeId>
  operator()(const BetweenFactor& factor) const
  {
    return {factor.from, factor.to};
  }

  template <typename Factor>
  std::vector<NodeId>
  operator()(const Factor& factor) const
  {
    return {factor.node};
  }
};

struct ModelMaker {
  ErrorModel
  operator()(const BetweenFactor& factor) const
  {
    ErrorModel model;
    model.measured = toSolverPose(factor.T_from_to);
    return model;
  }

  ErrorModel
  operator()(const PriorFactor& factor) const
  {
    ErrorModel model;
    model.measured = toSolverPose(factor.T_world_node);
    return model;
  }

  ErrorModel
  operator()(const PositionFactor& factor) const
  {
    return {ErrorKind::Position, {}, factor.point_world, factor.point_node};
  }

  ErrorModel
  operator()(const DirectionFactor& factor) const
  {
    return {ErrorKind::Direction,
            {},
            factor.direction_world.normalized(),
            factor.direction_node.normalized()};
  }
};

} // namespace

ErrorModel
errorModelOf(const Measurement& measurement)
{
  return std::visit(ModelMaker(), measurement);
}

std::string
flawOf(const Measurement& measurement)
{
  return std::visit(FlawFinder(), measurement);
}

std::vector<NodeId>
nodesOf(const Measurement& measurement)
{
  return std::visit(NodeLister(), measurement);
}

FactorLinearization
linearize(const Measurement& measurement,
          const Eigen::Isometry3d& T_world_first,
          const Eigen::Isometry3d& T_world_second)
{
  const ErrorModel model = errorModelOf(measurement);
  const bool between = std::holds_alternative<BetweenFactor>(measurement);
  ErrorValues values;
  linearizeError(model,
                 between ? toSolverPose(T_world_first) : SolverPose(),
                 toSolverPose(between ? T_world_second : T_world_first),
                 values);
  const Eigen::Index rows = model.kind == ErrorKind::Pose ? 6 : 3;
  FactorLinearization result;
  result.error = values.error.head(rows);
  result.jacobian_first = (between ? values.first : values.second).topRows(rows);
  if (between)
    result.jacobian_second = values.second.topRows(rows);
  return result;
}

} // namespace nurbs
} // namespace pcl
