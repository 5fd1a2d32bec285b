// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/conics.h>
#include <pcl/surface/nurbs/segment_fitter.h>

#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

/** Direction that is most at right angles to the normals; normals that disagree lose
 * their weight (iteratively reweighted, Cauchy). */
Eigen::Vector3d
axisOfNormals(const Eigen::Matrix3Xd& normals)
{
  constexpr int kRounds = 10;
  constexpr double kScale = 0.1; // sine of a disagreement that is still accepted
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(normals.cols());
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
        normals * weights.asDiagonal() * normals.transpose());
    axis = eigen.eigenvectors().col(0);
    const Eigen::ArrayXd sine = (normals.transpose() * axis).array() / kScale;
    weights = (1.0 + sine.square()).inverse();
  }
  return axis;
}

/** Algebraic circle through the points' projections (Kasa): |p|^2 = 2 c.p + k. */
CylinderAxis
circleAcross(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& direction)
{
  const Eigen::Isometry3d frame = frameFromAxis(points.rowwise().mean(), direction);
  const Eigen::Matrix2Xd flat =
      (frame.linear().transpose() * (points.colwise() - frame.translation()))
          .topRows(2);
  Eigen::MatrixXd rows(flat.cols(), 3);
  rows << 2.0 * flat.transpose(), Eigen::VectorXd::Ones(flat.cols());
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows);
  const Eigen::Vector3d circle =
      qr.solve(flat.colwise().squaredNorm().transpose().eval());
  CylinderAxis result{frame, std::sqrt(circle(2) + circle.head<2>().squaredNorm())};
  result.frame.translate(Eigen::Vector3d(circle(0), circle(1), 0.0));
  if (qr.rank() < 3 || !std::isfinite(result.radius) || !(result.radius > 0.0))
    throw std::domain_error("cylinder: the points do not determine an axis");
  return result;
}

/** Distance of a point, in the frame of the start, from a cylinder whose axis goes
 * through (x, y, 0) in the direction (a, b, 1). */
struct CylinderDistance {
  Eigen::Vector3d point;

  template <typename T>
  bool
  operator()(const T* axis, T* residual) const
  {
    const Eigen::Matrix<T, 3, 1> direction(axis[2], axis[3], T(1.0));
    const Eigen::Matrix<T, 3, 1> offset(
        point.x() - axis[0], point.y() - axis[1], T(point.z()));
    residual[0] = (offset.cross(direction)).norm() / direction.norm() - axis[4];
    return true;
  }
};

CylinderAxis
refine(const CylinderAxis& start, const Eigen::Matrix3Xd& points, double sigma)
{
  constexpr Eigen::Index kMostPoints = 5000;
  constexpr double kOutlier = 3.0; // standard deviations
  const Eigen::Index step = (points.cols() + kMostPoints - 1) / kMostPoints;
  double axis[5] = {0.0, 0.0, 0.0, 0.0, start.radius};
  ceres::Problem problem;
  for (Eigen::Index k = 0; k < points.cols(); k += step) {
    auto* loss = sigma > 0.0 ? new ceres::CauchyLoss(kOutlier * sigma) : nullptr;
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<CylinderDistance, 1, 5>(
            new CylinderDistance{start.frame.inverse() * points.col(k)}),
        loss,
        axis);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 50;
  options.function_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable() || !(axis[4] > 0.0))
    throw std::domain_error("cylinder: the points do not determine an axis");
  const Eigen::Vector3d through = start.frame * Eigen::Vector3d(axis[0], axis[1], 0.0);
  return {frameFromAxis(through,
                        start.frame.linear() * Eigen::Vector3d(axis[2], axis[3], 1.0)),
          axis[4]};
}

} // namespace

CylinderAxis
fitCylinderAxis(const Eigen::Matrix3Xd& points, const LocalPlanes& planes)
{
  if (points.cols() < 5 || planes.normals.cols() < 2)
    throw std::domain_error("cylinder: too few points or local planes");
  const CylinderAxis start = circleAcross(points, axisOfNormals(planes.normals));
  return refine(start, points, planes.sigma);
}

} // namespace nurbs
} // namespace pcl
