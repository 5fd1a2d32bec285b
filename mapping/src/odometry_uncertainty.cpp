// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "odometry_uncertainty.h"

#include "pose_graph_problem.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace pcl {
namespace nurbs {
namespace {

/** The trusted measured motion between two nodes, if there is one. */
std::optional<UncertainMotion>
measuredMotion(const PoseGraph& graph,
               NodeId from,
               NodeId to,
               const std::set<FactorId>& distrusted)
{
  for (const FactorId id : graph.node(to).factors) {
    const PoseFactor& factor = graph.factor(id);
    const auto* between = std::get_if<BetweenFactor>(&factor.measurement);
    if (between == nullptr || factor.weight == 0.0 || distrusted.count(id) > 0)
      continue;
    const UncertainMotion motion{
        between->T_from_to,
        covarianceOf(between->information, graph.node(to).planar) / factor.weight};
    if (between->from == from && between->to == to)
      return motion;
    if (between->from == to && between->to == from)
      return reversed(motion);
  }
  return std::nullopt;
}

template <int Size>
Eigen::Matrix<double, Size, Size>
inverseOf(const Eigen::Matrix<double, Size, Size>& information)
{
  constexpr double kUnknown = 1e-9; // of the best known direction's information
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Size, Size>> parts(
      information);
  const double least = kUnknown * parts.eigenvalues()(Size - 1);
  return parts.eigenvectors() *
         parts.eigenvalues().cwiseMax(least).cwiseInverse().asDiagonal() *
         parts.eigenvectors().transpose();
}

} // namespace

TangentMatrix
NoiseScale::applyTo(const TangentMatrix& covariance) const
{
  Tangent factors;
  factors << Eigen::Vector3d::Constant(translation),
      Eigen::Vector3d::Constant(rotation);
  return factors.asDiagonal() * covariance * factors.asDiagonal();
}

TangentMatrix
covarianceOf(const TangentMatrix& information, bool planar)
{
  if (!planar)
    return inverseOf<6>(information);
  const Eigen::Matrix3d part = inverseOf<3>(planarPart(information));
  TangentMatrix result = TangentMatrix::Zero();
  for (Eigen::Index r = 0; r < 3; ++r)
    for (Eigen::Index c = 0; c < 3; ++c)
      result(kPlanarRows[static_cast<std::size_t>(r)],
             kPlanarRows[static_cast<std::size_t>(c)]) = part(r, c);
  return result;
}

UncertainMotion
reversed(const UncertainMotion& motion)
{
  const TangentMatrix change = adjoint(motion.T_from_to);
  return {motion.T_from_to.inverse(), change * motion.covariance * change.transpose()};
}

double
squaredDistance(const Tangent& error, const TangentMatrix& covariance, bool planar)
{
  if (!planar)
    return error.dot(covariance.ldlt().solve(error));
  const Eigen::Vector3d part(
      error(kPlanarRows[0]), error(kPlanarRows[1]), error(kPlanarRows[2]));
  return part.dot(planarPart(covariance).ldlt().solve(part));
}

Eigen::Matrix3d
planarPart(const TangentMatrix& matrix)
{
  Eigen::Matrix3d part;
  for (Eigen::Index r = 0; r < 3; ++r)
    for (Eigen::Index c = 0; c < 3; ++c)
      part(r, c) = matrix(kPlanarRows[static_cast<std::size_t>(r)],
                          kPlanarRows[static_cast<std::size_t>(c)]);
  return part;
}

OdometryUncertainty::OdometryUncertainty(const PoseGraph& graph,
                                         const std::set<FactorId>& distrusted,
                                         const NoiseScale& scale,
                                         bool correlated)
    : correlated_(correlated)
{
  names_.reserve(graph.nodes().size());
  places_.reserve(graph.nodes().size());
  for (const auto& [id, node] : graph.nodes()) {
    Place place;
    if (!places_.empty()) {
      const Place& before = places_.back();
      const auto motion = measuredMotion(graph, names_.back(), id, distrusted);
      place.stretch = before.stretch + (motion ? 0 : 1);
      if (motion) {
        place.T_start_node = orthonormal(before.T_start_node * motion->T_from_to);
        const TangentMatrix change = adjoint(place.T_start_node);
        place.covariance = before.covariance + change *
                                                   scale.applyTo(motion->covariance) *
                                                   change.transpose();
      }
    }
    names_.push_back(id);
    places_.push_back(place);
  }
}

std::size_t
OdometryUncertainty::indexOf(NodeId id) const
{
  return nurbs::indexOf(names_, id);
}

std::optional<UncertainMotion>
OdometryUncertainty::motion(NodeId from, NodeId to) const
{
  const Place& first = places_[indexOf(from)];
  const Place& second = places_[indexOf(to)];
  if (first.stretch != second.stretch)
    return std::nullopt;
  TangentMatrix between = from < to ? second.covariance - first.covariance
                                    : first.covariance - second.covariance;
  if (correlated_)
    between *= static_cast<double>(from < to ? indexOf(to) - indexOf(from)
                                             : indexOf(from) - indexOf(to));
  const TangentMatrix change = adjoint(second.T_start_node.inverse());
  return UncertainMotion{first.T_start_node.inverse() * second.T_start_node,
                         change * between * change.transpose()};
}

} // namespace nurbs
} // namespace pcl
