// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "coded_net.h"

#include <optional>

namespace pcl {
namespace nurbs {

/** \brief Rows of \a points as affine functions of the Greville abscissae, plus one
 * scalar per point along one direction. */
struct AffinePlusScalar {
  Eigen::MatrixXd affine;    // rows x 3: value at the centre, slopes in g and k
  Eigen::VectorXd direction; // unit length; zero if the affine part is all there is
};

/** \brief Columns (1, g - g_c, k - k_c), one for each control point. */
Eigen::Matrix3Xd
affineBasis(const GrevilleGrid& greville);

/** \brief Least-squares affine part and what is left beside it; empty if that needs
 * more than one scalar per point, given what may be left out as \a tolerance. */
std::optional<AffinePlusScalar>
affinePlusScalar(const Eigen::MatrixXd& points,
                 const GrevilleGrid& greville,
                 double tolerance);

} // namespace nurbs
} // namespace pcl
