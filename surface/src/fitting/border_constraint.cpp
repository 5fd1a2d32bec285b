// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "border_constraint.h"

#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

bool
isAlongV(Border border)
{
  return border == Border::UMin || border == Border::UMax;
}

/** Indices of the control points \a depth rows away from a border, along the border. */
std::vector<int>
borderRow(Border border, int n_u, int n_v, int depth)
{
  std::vector<int> result;
  const int length = isAlongV(border) ? n_v : n_u;
  for (int k = 0; k < length; ++k)
    switch (border) {
    case Border::UMin:
      result.push_back(depth * n_v + k);
      break;
    case Border::UMax:
      result.push_back((n_u - 1 - depth) * n_v + k);
      break;
    case Border::VMin:
      result.push_back(k * n_v + depth);
      break;
    case Border::VMax:
      result.push_back(k * n_v + n_v - 1 - depth);
      break;
    }
  return result;
}

bool
sameKnots(const KnotVector& a, const KnotVector& b)
{
  constexpr double kTolerance = 1e-12;
  if (a.degree() != b.degree() || a.size() != b.size())
    return false;
  const KnotVector unit_a = a.rescaled(0.0, 1.0);
  const KnotVector unit_b = b.rescaled(0.0, 1.0);
  for (int i = 0; i < a.size(); ++i)
    if (std::abs(unit_a[i] - unit_b[i]) > kTolerance)
      return false;
  return true;
}

/** Mean distance between two rows of points. */
double
meanDistance(const NurbsSurface::HomogeneousPoints& points,
             const std::vector<int>& first,
             const std::vector<int>& second)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < first.size(); ++k)
    sum += (points.col(first[k]).hnormalized() - points.col(second[k]).hnormalized())
               .norm();
  return sum / static_cast<double>(first.size());
}

} // namespace

void
applyBorderConstraint(const BorderConstraint& constraint,
                      const KnotVector& knots_u,
                      const KnotVector& knots_v,
                      Eigen::MatrixXd& unknowns,
                      std::vector<bool>& fixed)
{
  const NurbsSurface& neighbour = constraint.neighbour;
  const KnotVector& along = isAlongV(constraint.border) ? knots_v : knots_u;
  const KnotVector& across = isAlongV(constraint.border) ? knots_u : knots_v;
  const KnotVector& neighbour_along =
      isAlongV(constraint.neighbour_border) ? neighbour.knotsV() : neighbour.knotsU();
  const KnotVector& neighbour_across =
      isAlongV(constraint.neighbour_border) ? neighbour.knotsU() : neighbour.knotsV();
  if (!sameKnots(along, neighbour_along))
    throw std::invalid_argument(
        "border constraint: the knots along the two borders differ");
  if (!across.isClamped() || !neighbour_across.isClamped())
    throw std::invalid_argument(
        "border constraint: the knots across the border must be clamped");

  const auto rowOf = [&](int depth) {
    return borderRow(constraint.border,
                     knots_u.numControlPoints(),
                     knots_v.numControlPoints(),
                     depth);
  };
  const auto neighbourRow = [&](int depth) {
    return borderRow(constraint.neighbour_border,
                     neighbour.numControlPointsU(),
                     neighbour.numControlPointsV(),
                     depth);
  };
  const NurbsSurface::HomogeneousPoints& given = neighbour.homogeneousPoints();
  const std::vector<int> border = rowOf(0);
  const std::vector<int> next = rowOf(1);
  const std::vector<int> given_border = neighbourRow(0);
  const std::vector<int> given_next = neighbourRow(1);
  const double ratio = meanDistance(unknowns.transpose(), border, next) /
                       meanDistance(given, given_border, given_next);
  for (std::size_t k = 0; k < border.size(); ++k) {
    const Eigen::Vector4d at = given.col(given_border[k]);
    unknowns.row(border[k]) = at.transpose();
    fixed[static_cast<std::size_t>(border[k])] = true;
    if (constraint.continuity == Continuity::C0)
      continue;
    unknowns.row(next[k]) = (at + ratio * (at - given.col(given_next[k]))).transpose();
    fixed[static_cast<std::size_t>(next[k])] = true;
  }
}

} // namespace nurbs
} // namespace pcl
