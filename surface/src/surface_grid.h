// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>
#include <pcl/surface/nurbs/tessellation.h>

#include <Eigen/Core>

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

  /** \brief Lengths in space of a unit step in u and in v, averaged. */
  const Eigen::Vector2d&
  scale() const
  {
    return scale_;
  }

private:
  std::vector<double> u_;
  std::vector<double> v_;
  Eigen::Vector2d scale_;
};

} // namespace nurbs
} // namespace pcl
