// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "factor_terms.h"

namespace pcl {
namespace nurbs {
namespace {

using Columns = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6>; // 6 or 3 of them
using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

Columns
columnsFor(const TermEnd& end, const TangentMatrix& jacobian)
{
  if (!end.planar)
    return jacobian;
  Columns result(6, 3);
  for (int k = 0; k < 3; ++k)
    result.col(k) = jacobian.col(kPlanarRows[static_cast<std::size_t>(k)]);
  return result;
}

void
addSpatial(const TermEnd& a,
           const TermEnd& b,
           const TangentMatrix& by_a,
           const TangentMatrix& by_b,
           const Tangent& error,
           FrontView& front)
{
  front.add(a.variable, a.variable, (by_a.transpose() * by_a).eval());
  front.add(b.variable, b.variable, (by_b.transpose() * by_b).eval());
  front.add(b.variable, a.variable, (by_b.transpose() * by_a).eval());
  front.addRight(a.variable, (-error.transpose() * by_a).eval());
  front.addRight(b.variable, (-error.transpose() * by_b).eval());
}

} // namespace

void
addFactor(const ProblemFactor& factor,
          const SolverPose& first,
          const SolverPose& second,
          const TermEnd& first_end,
          const TermEnd& second_end,
          FrontView& front)
{
  ErrorValues values;
  linearizeError(factor.model, first, second, values);
  const Tangent error = factor.root * values.error;
  const TangentMatrix by_first = factor.root * values.first;
  const TangentMatrix by_second = factor.root * values.second;
  const bool both = first_end.variable >= 0 && second_end.variable >= 0;
  if (both && !first_end.planar && !second_end.planar) {
    addSpatial(first_end, second_end, by_first, by_second, error, front);
    return;
  }
  const Columns a = columnsFor(first_end, by_first);
  const Columns b = columnsFor(second_end, by_second);
  const auto addOne = [&](const TermEnd& end, const Columns& columns) {
    if (end.variable < 0)
      return;
    front.add(end.variable, end.variable, Block(columns.transpose() * columns));
    front.addRight(end.variable, Block(-error.transpose() * columns));
  };
  addOne(first_end, a);
  addOne(second_end, b);
  if (both)
    front.add(second_end.variable, first_end.variable, Block(b.transpose() * a));
}

Tangent
tangentFrom(const Eigen::Map<const Eigen::MatrixXd>& solution, bool planar)
{
  if (!planar)
    return solution;
  Tangent result = Tangent::Zero();
  for (int k = 0; k < 3; ++k)
    result(kPlanarRows[static_cast<std::size_t>(k)]) = solution(k);
  return result;
}

} // namespace nurbs
} // namespace pcl
