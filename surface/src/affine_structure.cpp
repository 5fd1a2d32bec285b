// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "affine_structure.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace pcl {
namespace nurbs {

Eigen::Matrix3Xd
affineBasis(const GrevilleGrid& greville)
{
  const auto& [g, k] = greville.values;
  Eigen::Matrix3Xd basis(3, static_cast<Eigen::Index>(g.size() * k.size()));
  Eigen::Index column = 0;
  for (double u : g)
    for (double v : k)
      basis.col(column++) << 1.0, u - greville.centre(0), v - greville.centre(1);
  return basis;
}

std::optional<AffinePlusScalar>
affinePlusScalar(const Eigen::MatrixXd& points,
                 const GrevilleGrid& greville,
                 double tolerance)
{
  const Eigen::Matrix3Xd basis = affineBasis(greville);
  const Eigen::Matrix3d gram = basis * basis.transpose();
  AffinePlusScalar result;
  result.affine =
      gram.ldlt().solve(basis * points.transpose()).transpose(); // least squares
  Eigen::MatrixXd rest = points - result.affine * basis;
  result.direction = Eigen::VectorXd::Zero(points.rows());
  if (rest.cwiseAbs().maxCoeff() <= tolerance)
    return result;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(rest * rest.transpose());
  const Eigen::VectorXd direction = solver.eigenvectors().rightCols<1>();
  rest -= direction * (direction.transpose() * rest);
  if (!(rest.cwiseAbs().maxCoeff() <= tolerance))
    return std::nullopt;
  result.direction = direction;
  return result;
}

} // namespace nurbs
} // namespace pcl
