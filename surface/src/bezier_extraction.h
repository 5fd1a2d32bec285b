// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief One polynomial piece of a surface in homogeneous Bernstein form, of a fixed
 * size so that subdivision runs on the stack. A curve is a piece of degree 0 in v. */
struct BezierPatch {
  static constexpr int kMaxPoints = (kMaxDegree + 1) * (kMaxDegree + 1);

  int degree_u = 0;
  int degree_v = 0;
  double u_min = 0.0;
  double u_max = 0.0;
  double v_min = 0.0;
  double v_max = 0.0;
  /** Point (i, j) is element i * (degree_v + 1) + j. */
  std::array<Eigen::Vector4d, kMaxPoints> points;

  int
  size() const
  {
    return (degree_u + 1) * (degree_v + 1);
  }

  const Eigen::Vector4d&
  operator()(int i, int j) const
  {
    return points[static_cast<std::size_t>(i * (degree_v + 1) + j)];
  }

  Eigen::Vector4d&
  operator()(int i, int j)
  {
    return points[static_cast<std::size_t>(i * (degree_v + 1) + j)];
  }

  Eigen::Vector3d
  cartesian(int i, int j) const
  {
    const Eigen::Vector4d& point = (*this)(i, j);
    return point.head<3>() / point(3);
  }

  /** \brief Homogeneous point at \a s, \a t in [0, 1] of the piece (de Casteljau). */
  Eigen::Vector4d
  evaluate(double s, double t) const;

  /** \brief The halves of the piece at its middle (de Casteljau, algorithm A1.5). */
  void
  split(Direction direction, BezierPatch& low, BezierPatch& high) const;

  /** \brief Direction in which the control net is longer: the one to split next. */
  Direction
  longerDirection() const;
};

/** \brief All non-empty spans of a surface as Bézier pieces, u slowest. Any knots:
 * control points are blossom values, so the ends need not be clamped. */
std::vector<BezierPatch>
extractBezier(const NurbsSurface& surface);

/** \brief All non-empty spans of a curve; a plane curve gets z = 0. */
template <int Dim>
std::vector<BezierPatch>
extractBezier(const NurbsCurve<Dim>& curve);

extern template std::vector<BezierPatch>
extractBezier<2>(const NurbsCurve<2>&);
extern template std::vector<BezierPatch>
extractBezier<3>(const NurbsCurve<3>&);

} // namespace nurbs
} // namespace pcl
