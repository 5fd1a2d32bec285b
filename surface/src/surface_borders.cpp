// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/surface_borders.h>

namespace pcl {
namespace nurbs {

NurbsCurve3
borderCurve(const NurbsSurface& surface, SurfaceBorder border)
{
  switch (border) {
  case SurfaceBorder::UMin:
    return surface.isoCurve(Direction::U, surface.knotsU().domainMin());
  case SurfaceBorder::UMax:
    return surface.isoCurve(Direction::U, surface.knotsU().domainMax());
  case SurfaceBorder::VMin:
    return surface.isoCurve(Direction::V, surface.knotsV().domainMin());
  default:
    return surface.isoCurve(Direction::V, surface.knotsV().domainMax());
  }
}

bool
isDegenerate(const NurbsSurface& surface, SurfaceBorder border, double tolerance)
{
  const NurbsCurve3 curve = borderCurve(surface, border);
  const Eigen::Vector3d first = curve.controlPoint(0);
  for (int i = 1; i < curve.numControlPoints(); ++i)
    if ((curve.controlPoint(i) - first).norm() > tolerance)
      return false;
  return true;
}

bool
isClosed(const NurbsSurface& surface, Direction direction, double tolerance)
{
  const bool in_u = direction == Direction::U;
  const NurbsCurve3 start =
      borderCurve(surface, in_u ? SurfaceBorder::UMin : SurfaceBorder::VMin);
  const NurbsCurve3 end =
      borderCurve(surface, in_u ? SurfaceBorder::UMax : SurfaceBorder::VMax);
  const std::vector<double> breaks = start.knots().breaks();
  const int samples = 2 * start.degree() + 1;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int k = 0; k < samples; ++k) {
      const double u = breaks[i] + (breaks[i + 1] - breaks[i]) * k / (samples - 1);
      if ((start.evaluate(u) - end.evaluate(u)).norm() > tolerance)
        return false;
    }
  return true;
}

} // namespace nurbs
} // namespace pcl
