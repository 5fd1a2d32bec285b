// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "homogeneous_spline.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace nurbs {
namespace detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

} // namespace

double
leastWeight(const Eigen::Ref<const Eigen::MatrixXd>& points, int point_rows)
{
  double least = kInfinity;
  for (Eigen::Index row = point_rows - 1; row < points.rows(); row += point_rows)
    least = std::min(least, points.row(row).minCoeff());
  return least;
}

double
deviationBound(const Eigen::Ref<const Eigen::MatrixXd>& defects,
               const Eigen::Ref<const Eigen::MatrixXd>& old_points,
               double least_weight,
               int point_rows)
{
  if (!(least_weight > 0.0))
    return kInfinity;
  const int dim = point_rows - 1;
  const auto homogeneousPoints = [=](const Eigen::MatrixXd& columns) {
    return Eigen::MatrixXd(Eigen::Map<const Eigen::MatrixXd>(
        columns.data(), point_rows, columns.size() / point_rows));
  };
  const Eigen::MatrixXd hull = homogeneousPoints(old_points).colwise().hnormalized();
  const Eigen::VectorXd center = hull.rowwise().mean();
  const double radius = (hull.colwise() - center).colwise().norm().maxCoeff();
  const Eigen::MatrixXd defect = homogeneousPoints(defects);
  double worst = 0.0;
  for (Eigen::Index i = 0; i < defect.cols(); ++i) {
    const double weight = defect(dim, i);
    worst = std::max(worst,
                     (defect.col(i).head(dim) - weight * center).norm() +
                         radius * std::abs(weight));
  }
  return worst / least_weight;
}

} // namespace detail
} // namespace nurbs
} // namespace pcl
