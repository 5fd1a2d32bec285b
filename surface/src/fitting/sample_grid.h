// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Points gathered in the bins of a lattice over their parameter domain; each
 * occupied bin is one sample at the centroid of its points.
 *
 * The knot search works on samples: bins as large as the correlation of the noise are
 * independent, and there are few of them however many points there are.
 */
struct SampleGrid {
  Eigen::Vector2d low;      /**< corner of the domain */
  Eigen::Vector2d bin_size; /**< extent of a bin in u and v */
  int rows = 0;             /**< bins along u */
  int columns = 0;          /**< bins along v */
  std::vector<int> bin; /**< lattice index (row * columns + column) of each sample */
  Eigen::Matrix2Xd parameters; /**< centroid of each sample */
  Eigen::MatrixXd values;      /**< samples x value dimensions: mean of the points */
  Eigen::VectorXd weights;     /**< sum of the points' weights */

  Eigen::Index
  size() const
  {
    return weights.size();
  }

  /** \brief Bin points.
   * \param[in] low corner of the domain
   * \param[in] high opposite corner
   * \param[in] parameters (u, v) of each point
   * \param[in] values one row per point
   * \param[in] weights one per point
   * \param[in] target_samples about how many bins to make */
  SampleGrid(const Eigen::Vector2d& low,
             const Eigen::Vector2d& high,
             const Eigen::Matrix2Xd& parameters,
             const Eigen::MatrixXd& values,
             const Eigen::VectorXd& weights,
             int target_samples);

  /** \brief Robust standard deviation of a sample of unit weight: the median over small
   * windows of the variance around a local quadratic, so it needs no model of the
   * whole. Zero if no window has enough samples. */
  double
  noise() const;
};

} // namespace nurbs
} // namespace pcl
