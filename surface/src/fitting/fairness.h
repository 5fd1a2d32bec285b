// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "cell_equations.h"

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Weights of the smoothing energy
 * \f$\int\int w_2 (f_{uu}^2 + 2 f_{uv}^2 + f_{vv}^2) + w_1 (f_u^2 + f_v^2)\f$
 * over the domain scaled to its unit square. */
struct FairnessWeights {
  double thin_plate = 0.0;
  double membrane = 0.0;
};

/** \brief Add the exact energy of each cell to its equations (one unknown per control
 * point). */
void
addFairness(const CellPoints& points,
            const FairnessWeights& weights,
            std::vector<CellEquations>& cells);

/** \brief The same relative to present unknowns: the equations then ask for a step.
 * \param[in] unknowns channels x control points
 * \param[in] derivatives whether gram and rhs are wanted, or only the energy itself */
void
addFairnessAround(const CellPoints& points,
                  const FairnessWeights& weights,
                  const Eigen::MatrixXd& unknowns,
                  bool derivatives,
                  std::vector<CellEquations>& cells);

} // namespace nurbs
} // namespace pcl
