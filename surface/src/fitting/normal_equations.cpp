// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "normal_equations.h"

#include <algorithm>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Distance of the outermost entries from the diagonal: degree rows of the net and
 * degree points. */
Eigen::Index
bandWidth(const CellPoints& points)
{
  const Eigen::Index p = points.cells_u.degree();
  const Eigen::Index q = points.cells_v.degree();
  return std::min(p * points.cells_v.numControlPoints() + q,
                  q * points.cells_u.numControlPoints() + p);
}

} // namespace

NormalEquations::NormalEquations(const CellPoints& points,
                                 const std::vector<CellEquations>& cells)
    : n_u_(points.cells_u.numControlPoints()),
      n_v_(points.cells_v.numControlPoints()),
      u_fastest_(points.cells_u.degree() + points.cells_v.degree() * n_u_ <
                 points.cells_u.degree() * n_v_ + points.cells_v.degree()),
      gram_(points.numControlPoints(), bandWidth(points)),
      rhs_(Eigen::MatrixXd::Zero(points.numControlPoints(), cells.front().rhs.cols()))
{
  std::vector<Eigen::Index> at;
  for (int cell = 0; cell < points.numCells(); ++cell) {
    const CellEquations& equations = cells[static_cast<std::size_t>(cell)];
    at.clear();
    for (int control : points.controls(cell))
      at.push_back(position(control));
    for (std::size_t k = 0; k < at.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      rhs_.row(at[k]) += equations.rhs.row(column);
      for (std::size_t i = 0; i < at.size(); ++i)
        if (at[i] >= at[k])
          gram_(at[i], at[k]) += equations.gram(static_cast<Eigen::Index>(i), column);
    }
  }
}

/** Replace the equation of an unknown, whose value is in \a rhs, by "unknown = value".
 */
void
NormalEquations::fix(Eigen::Index at, BandMatrix& gram, Eigen::MatrixXd& rhs)
{
  const Eigen::Index first = std::max<Eigen::Index>(0, at - gram.width());
  const Eigen::Index last = std::min(gram.size() - 1, at + gram.width());
  for (Eigen::Index other = first; other <= last; ++other) {
    if (other == at)
      continue;
    double& entry = gram(std::max(at, other), std::min(at, other));
    rhs.row(other) -= entry * rhs.row(at);
    entry = 0.0;
  }
  gram(at, at) = 1.0;
}

bool
NormalEquations::solve(const std::vector<bool>& fixed, Eigen::MatrixXd& unknowns) const
{
  BandMatrix factor = gram_;
  Eigen::MatrixXd solution = rhs_;
  for (std::size_t control = 0; control < fixed.size(); ++control)
    if (fixed[control]) {
      const auto row = static_cast<Eigen::Index>(control);
      solution.row(position(row)) = unknowns.row(row);
      fix(position(row), factor, solution);
    }
  if (!factor.factorize())
    return false;
  factor.solveInPlace(solution);
  if (!solution.allFinite())
    return false;
  for (Eigen::Index control = 0; control < unknowns.rows(); ++control)
    if (fixed.empty() || !fixed[static_cast<std::size_t>(control)])
      unknowns.row(control) = solution.row(position(control));
  return true;
}

} // namespace nurbs
} // namespace pcl
