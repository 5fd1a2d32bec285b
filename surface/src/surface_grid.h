// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>
#include <pcl/surface/nurbs/tessellation.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Lines of constant u and v that cut the domain into cells, each flat to the
 * tolerance. */
class SurfaceGrid {
public:
  /** \throws std::domain_error if more than 2^24 points are needed */
  SurfaceGrid(const NurbsSurface& surface, const TessellationOptions& options);

  const std::vector<double>&
  u() const
  {
    return u_;
  }

  const std::vector<double>&
  v() const
  {
    return v_;
  }

  int
  cellsU() const
  {
    return static_cast<int>(u_.size()) - 1;
  }

  int
  cellsV() const
  {
    return static_cast<int>(v_.size()) - 1;
  }

  /** \brief Position counted in cells: whole numbers on the lines. */
  Eigen::Vector2d
  cellCoordinates(const Eigen::Vector2d& uv) const;

  /** \brief Number of the line of constant u (axis 0) or v (axis 1), strictly between
   * two cell coordinates, over which the surface may have a crease: a knot of full
   * multiplicity. Triangles must not reach over it. -1 if there is none. */
  int
  creaseBetween(int axis, double a, double b) const;

  /** \brief The lines of an axis that may be creases. */
  const std::vector<int>&
  creases(int axis) const
  {
    return creases_[static_cast<std::size_t>(axis)];
  }

  /** \brief Lengths in space of a unit step in u and in v, averaged. */
  const Eigen::Vector2d&
  scale() const
  {
    return scale_;
  }

private:
  std::vector<double> u_;
  std::vector<double> v_;
  std::array<std::vector<int>, 2> creases_;
  Eigen::Vector2d scale_;
};

} // namespace nurbs
} // namespace pcl
