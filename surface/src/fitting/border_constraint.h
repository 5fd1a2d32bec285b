// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/surface_fitter.h>

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Give the control points next to a border the values that continue its
 * neighbour: the border row for C0; for G1 also the next row, on the prolonged tangent
 * of the neighbour, as far away as \a unknowns has it on average (equation: S_v = ratio
 * N_v along the border, a sufficient condition for equal tangent planes).
 * \param[in] constraint which border continues what
 * \param[in] knots_u knots of the fitted surface
 * \param[in] knots_v knots of the fitted surface
 * \param[in,out] unknowns (control points) x 4 homogeneous control points
 * \param[in,out] fixed control points that now have their value
 * \throws std::invalid_argument if the knots along the two borders differ */
void
applyBorderConstraint(const BorderConstraint& constraint,
                      const KnotVector& knots_u,
                      const KnotVector& knots_v,
                      Eigen::MatrixXd& unknowns,
                      std::vector<bool>& fixed);

} // namespace nurbs
} // namespace pcl
