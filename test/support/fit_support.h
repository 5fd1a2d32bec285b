// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "random_nurbs.h"

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

/** Parameters at equal steps that end exactly at the ends. */
inline std::vector<double>
evenParameters(int count, double first = 0.0, double last = 1.0)
{
  std::vector<double> parameters;
  for (int i = 0; i < count; ++i)
    parameters.push_back(i + 1 == count ? last
                                        : first + (last - first) * i / (count - 1));
  return parameters;
}

/** Random points that advance along x. */
inline Eigen::Matrix3Xd
walk(RandomNurbs& random, int count)
{
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i)
    points.col(i) << i + random.uniform(-0.3, 0.3), random.normal(1.0),
        random.normal(1.0);
  return points;
}

/** Values of all basis functions (columns) at parameters (rows). */
inline Eigen::MatrixXd
collocation(const KnotVector& knots, const std::vector<double>& parameters)
{
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(
      static_cast<Eigen::Index>(parameters.size()), knots.numControlPoints());
  for (Eigen::Index k = 0; k < matrix.rows(); ++k) {
    const int span = knots.findSpan(parameters[k]);
    BasisValues basis;
    knots.evaluateBasis(span, parameters[k], basis);
    for (int r = 0; r <= knots.degree(); ++r)
      matrix(k, span - knots.degree() + r) = basis[r];
  }
  return matrix;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
