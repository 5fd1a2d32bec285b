// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/knot_vector.h>

#include <Eigen/Core>

#include <limits>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Degree and breaks of one direction: what a move changes. */
struct KnotAxis {
  int degree = 1;
  std::vector<double> breaks;

  KnotVector
  knots() const
  {
    return KnotVector::clamped(degree, breaks);
  }

  int
  controls() const
  {
    return degree + static_cast<int>(breaks.size()) - 1;
  }

  int
  innerKnots() const
  {
    return static_cast<int>(breaks.size()) - 2;
  }

  bool
  operator==(const KnotAxis& other) const
  {
    return degree == other.degree && breaks == other.breaks;
  }
};

/** \brief Degrees and knots of both directions, and how they fit the samples. */
struct KnotModel {
  KnotModel() = default;

  KnotModel(KnotAxis axis_u, KnotAxis axis_v)
      : u(std::move(axis_u)), v(std::move(axis_v))
  {
  }

  KnotAxis u;
  KnotAxis v;
  double criterion = std::numeric_limits<double>::infinity(); /**< less is better */
  Eigen::MatrixXd residuals; /**< samples x values, times the roots of the weights;
                                  empty if the model could not be fitted */
};

} // namespace nurbs
} // namespace pcl
