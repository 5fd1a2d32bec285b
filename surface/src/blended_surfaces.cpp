// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/constructions.h>
#include <pcl/surface/nurbs/knot_operations.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

using Column = Eigen::Vector4d;

NurbsCurve3
onUnitInterval(const NurbsCurve3& curve)
{
  return {curve.knots().rescaled(0.0, 1.0), curve.homogeneousPoints()};
}

/** The borders of a Coons patch: opposite pairs are compatible. */
struct Borders {
  NurbsCurve3::HomogeneousPoints bottom, top, left, right;
  KnotVector knots_u, knots_v;

  Borders(const std::vector<NurbsCurve3>& along_u,
          const std::vector<NurbsCurve3>& along_v)
      : bottom(along_u[0].homogeneousPoints()),
        top(along_u[1].homogeneousPoints()),
        left(along_v[0].homogeneousPoints()),
        right(along_v[1].homogeneousPoints()),
        knots_u(along_u[0].knots()),
        knots_v(along_v[0].knots())
  {
  }

  /** Both curves' ends at the corners (0,0), (1,0), (0,1), (1,1). */
  std::array<std::pair<Column, Column>, 4>
  corners() const
  {
    const Eigen::Index u = bottom.cols() - 1;
    const Eigen::Index v = left.cols() - 1;
    return {{{bottom.col(0), left.col(0)},
             {bottom.col(u), right.col(0)},
             {top.col(0), left.col(v)},
             {top.col(u), right.col(v)}}};
  }

  void
  requireMeeting(double tolerance) const
  {
    for (const auto& [a, b] : corners())
      if (!((a.hnormalized() - b.hnormalized()).norm() <= tolerance))
        throw std::invalid_argument("coonsSurface: the borders do not meet");
  }

  /** Scaling a curve's homogeneous points leaves it as it is: three factors make three
   * corners agree, the fourth must follow. */
  void
  matchWeights()
  {
    constexpr double kTolerance = 1e-12;
    left *= bottom(3, 0) / left(3, 0);
    right *= bottom(3, bottom.cols() - 1) / right(3, 0);
    top *= left(3, left.cols() - 1) / top(3, 0);
    const double last_top = top(3, top.cols() - 1);
    const double last_right = right(3, right.cols() - 1);
    if (std::abs(last_top - last_right) > kTolerance * last_top)
      throw std::invalid_argument(
          "coonsSurface: the weights of the borders cannot agree at the corners");
  }
};

} // namespace

NurbsSurface
ruledSurface(const NurbsCurve3& start, const NurbsCurve3& end)
{
  const std::vector<NurbsCurve3> pair = makeCompatible<3>({start, end});
  const int n = pair[0].numControlPoints();
  NurbsSurface::HomogeneousPoints points(4, 2 * n);
  for (int i = 0; i < n; ++i) {
    points.col(2 * i) = pair[0].homogeneousPoints().col(i);
    points.col(2 * i + 1) = pair[1].homogeneousPoints().col(i);
  }
  return {pair[0].knots(), KnotVector(), std::move(points)};
}

NurbsSurface
coonsSurface(const NurbsCurve3& bottom,
             const NurbsCurve3& top,
             const NurbsCurve3& left,
             const NurbsCurve3& right,
             double corner_tolerance)
{
  Borders b(makeCompatible<3>({onUnitInterval(bottom), top}),
            makeCompatible<3>({onUnitInterval(left), right}));
  b.requireMeeting(corner_tolerance);
  b.matchWeights();
  const Eigen::Index last_u = b.bottom.cols() - 1;
  const int m = static_cast<int>(b.left.cols());
  NurbsSurface::HomogeneousPoints points(4, b.bottom.cols() * m);
  for (int i = 0; i <= last_u; ++i)
    for (int j = 0; j < m; ++j) {
      // Greville abscissae are the control values of a linear function over any knots,
      // so the three surfaces of the sum share one control net without elevation.
      const double g = b.knots_u.greville(i);
      const double h = b.knots_v.greville(j);
      const Column ruled_v = (1.0 - h) * b.bottom.col(i) + h * b.top.col(i);
      const Column ruled_u = (1.0 - g) * b.left.col(j) + g * b.right.col(j);
      const Column low = (1.0 - g) * b.bottom.col(0) + g * b.bottom.col(last_u);
      const Column high = (1.0 - g) * b.top.col(0) + g * b.top.col(last_u);
      points.col(i * m + j) = ruled_v + ruled_u - ((1.0 - h) * low + h * high);
    }
  return {b.knots_u, b.knots_v, std::move(points)};
}

} // namespace nurbs
} // namespace pcl
