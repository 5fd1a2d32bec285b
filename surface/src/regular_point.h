// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {

/** \brief S_u x S_v as a unit vector; zero where the derivatives are parallel or one of
 * them vanishes beside the other. At a pole rounding leaves a derivative that is tiny
 * but has a direction, so lengths are compared too, over the whole domain to be free of
 * the units of the parameters. */
inline Eigen::Vector3d
unitNormal(const NurbsSurface& surface,
           const Eigen::Vector3d& s_u,
           const Eigen::Vector3d& s_v)
{
  constexpr double kVanishing = 1e-10;
  const Eigen::Vector3d u = surface.knotsU().domainLength() * s_u;
  const Eigen::Vector3d v = surface.knotsV().domainLength() * s_v;
  const double squared_u = u.squaredNorm();
  const double squared_v = v.squaredNorm();
  const Eigen::Vector3d cross = u.cross(v);
  const double squared = cross.squaredNorm();
  if (std::min(squared_u, squared_v) >
          kVanishing * kVanishing * std::max(squared_u, squared_v) &&
      squared > kVanishing * kVanishing * squared_u * squared_v)
    return cross / std::sqrt(squared);
  return Eigen::Vector3d::Zero();
}

} // namespace nurbs
} // namespace pcl
