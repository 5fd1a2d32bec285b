// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/trimmed_surface.h>

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief A part of a trimming curve with the surface that lifts it into space. */
class BorderPiece {
public:
  BorderPiece(const NurbsSurface& surface,
              const NurbsCurve2& curve,
              double first,
              double last)
      : surface_(&surface), curve_(&curve), first_(first), last_(last)
  {
  }

  double
  first() const
  {
    return first_;
  }

  double
  last() const
  {
    return last_;
  }

  const NurbsCurve2&
  curve() const
  {
    return *curve_;
  }

  /** \brief Parameter of the surface, kept inside of its domain. */
  Eigen::Vector2d
  parameter(double t) const;

  Eigen::Vector3d
  position(double t) const;

  /** \brief Parameter t of the point nearest to \a target that Gauss-Newton steps reach
   * from \a guess. */
  double
  project(const Eigen::Vector3d& target, double guess) const;

  /** \brief Like project(), from the best of some evenly spaced starts. */
  double
  projectFromAnywhere(const Eigen::Vector3d& target) const;

private:
  const NurbsSurface* surface_;
  const NurbsCurve2* curve_;
  double first_;
  double last_;
};

} // namespace nurbs
} // namespace pcl
