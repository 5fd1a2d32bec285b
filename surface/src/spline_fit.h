// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/knot_vector.h>

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {
namespace detail {

/** \brief Least-squares control columns of a spline for data columns at parameters.
 * \param[in] knots knots of the spline
 * \param[in] parameters one per data column, non-decreasing, in the domain
 * \param[in] data one column of any number of coordinates per parameter
 * \param[in] weights one per data column, or none
 * \param[in] fix_ends take the first and last data column as control columns
 * \throws std::invalid_argument if counts, order, domain or weights do not fit
 * \throws std::domain_error if the data do not determine every control column */
Eigen::MatrixXd
fitColumns(const KnotVector& knots,
           const std::vector<double>& parameters,
           const Eigen::Ref<const Eigen::MatrixXd>& data,
           const Eigen::VectorXd& weights,
           bool fix_ends);

/** \brief Control columns of the spline through all data columns; as many as there are
 * data. Conditions as for fitColumns(), parameters strictly increasing. */
Eigen::MatrixXd
interpolateColumns(const KnotVector& knots,
                   const std::vector<double>& parameters,
                   const Eigen::Ref<const Eigen::MatrixXd>& data);

/** \brief Contract check of a public fit. */
void
requireForFit(bool condition, const char* message);

/** \brief Whether each value is greater than the one before. */
bool
isStrictlyIncreasing(const std::vector<double>& values);

} // namespace detail
} // namespace nurbs
} // namespace pcl
