// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/segment_fitter.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr int kQuadricTerms = 6;

/** Variance of points around the quadric over their plane that fits them best.
 * \param[in] axes columns: first two span the plane */
double
varianceAroundQuadric(const Eigen::Matrix3Xd& centred, const Eigen::Matrix3d& axes)
{
  const double scale = std::sqrt(centred.colwise().squaredNorm().maxCoeff());
  const Eigen::Matrix3Xd local = axes.transpose() * centred / scale;
  Eigen::MatrixXd rows(local.cols(), kQuadricTerms);
  rows << Eigen::VectorXd::Ones(local.cols()), local.row(0).transpose(),
      local.row(1).transpose(), local.row(0).cwiseAbs2().transpose(),
      local.row(0).cwiseProduct(local.row(1)).transpose(),
      local.row(1).cwiseAbs2().transpose();
  const Eigen::VectorXd heights = local.row(2).transpose();
  const Eigen::VectorXd residual =
      heights - rows * rows.colPivHouseholderQr().solve(heights);
  const double freedom = static_cast<double>(local.cols() - kQuadricTerms);
  // So that the median of many is not too low (Wilson-Hilferty).
  const double median_of_chi_squared =
      freedom * std::pow(1.0 - 2.0 / (9.0 * freedom), 3);
  return scale * scale * residual.squaredNorm() / median_of_chi_squared;
}

} // namespace

LocalPlanes
localPlanes(const std::vector<Eigen::Matrix3Xd>& neighbourhoods)
{
  LocalPlanes result;
  const auto count = static_cast<Eigen::Index>(neighbourhoods.size());
  result.centres.resize(3, count);
  result.normals.resize(3, count);
  std::vector<double> variances;
  Eigen::Index used = 0;
  for (const Eigen::Matrix3Xd& points : neighbourhoods) {
    if (points.cols() <= kQuadricTerms)
      continue;
    const Eigen::Vector3d centre = points.rowwise().mean();
    const Eigen::Matrix3Xd centred = points.colwise() - centre;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(centred *
                                                               centred.transpose());
    if (!(eigen.eigenvalues()(1) > 0.0)) // a point or a line
      continue;
    result.centres.col(used) = centre;
    result.normals.col(used) = eigen.eigenvectors().col(0);
    ++used;
    variances.push_back(
        varianceAroundQuadric(centred, eigen.eigenvectors().rowwise().reverse()));
  }
  result.centres.conservativeResize(3, used);
  result.normals.conservativeResize(3, used);
  if (variances.empty())
    return result;
  const auto middle =
      variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  result.sigma = std::sqrt(*middle);
  return result;
}

} // namespace nurbs
} // namespace pcl
