// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "planar_patch.h"

#include <algorithm>
#include <array>
#include <limits>

namespace pcl {
namespace nurbs {

/** Whether the map of the first two components is one-to-one: the cross products of all
 * differences in u with all differences in v, whose hulls hold the derivatives, have
 * one sign. */
bool
isInjective(const BezierPatch& patch)
{
  std::array<Eigen::Vector2d, BezierPatch::kMaxPoints> along_v;
  int count = 0;
  for (int i = 0; i <= patch.degree_u; ++i)
    for (int j = 1; j <= patch.degree_v; ++j)
      along_v[count++] = (patch(i, j) - patch(i, j - 1)).head<2>();
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int i = 1; i <= patch.degree_u; ++i)
    for (int j = 0; j <= patch.degree_v; ++j) {
      const Eigen::Vector2d along_u = (patch(i, j) - patch(i - 1, j)).head<2>();
      for (int k = 0; k < count; ++k) {
        const double cross =
            along_u.x() * along_v[k].y() - along_u.y() * along_v[k].x();
        low = std::min(low, cross);
        high = std::max(high, cross);
      }
      if (low <= 0.0 && high >= 0.0)
        return false;
    }
  return true;
}

Eigen::Matrix3d
thinFrame(const BezierPatch& patch)
{
  const int p = patch.degree_u;
  const int q = patch.degree_v;
  const Eigen::Vector2d rising =
      (patch.cartesian(p, q) - patch.cartesian(0, 0)).head<2>();
  const Eigen::Vector2d falling =
      (patch.cartesian(p, 0) - patch.cartesian(0, q)).head<2>();
  const Eigen::Vector2d& longer =
      rising.squaredNorm() > falling.squaredNorm() ? rising : falling;
  const double length = longer.norm();
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  if (length > 0.0) {
    frame.topLeftCorner<1, 2>() = longer.transpose() / length;
    frame.block<1, 2>(1, 0) << -longer.y() / length, longer.x() / length;
  }
  return frame;
}

} // namespace nurbs
} // namespace pcl
