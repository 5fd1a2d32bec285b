// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_curve.h>
#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>

#include <memory>
#include <optional>

namespace pcl {
namespace nurbs {

/** \brief Foot point of a point on a surface. Lengths in the unit of the control
 * points. */
struct ClosestPoint {
  double u = 0.0;
  double v = 0.0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(); /**< \brief S(u, v) */
  double distance = 0.0;
  /** \brief Component of (query - foot) along the unit normal of the surface: at an
   * inner foot point plus or minus the distance, at a border the distance to the
   * tangent plane; 0 where there is no normal. */
  double signed_distance = 0.0;
  bool converged = false;   /**< \brief The descent reached a local minimum. */
  bool at_boundary = false; /**< \brief On the border of the domain (seams are not). */
};

/** \brief Orthogonal projection of points on a surface.
 *
 * Construction splits the surface into Bézier pieces and bounds them by a hierarchy of
 * oriented boxes, O(n log n) in the number of spans. Queries are const and may run from
 * many threads at once; copies share the prepared data.
 *
 * Local descent is Newton on the true distance (Piegl & Tiller, section 6.1, equations
 * 6.4 to 6.9), Gauss-Newton where the Hessian is not positive, with steps that never
 * increase the distance, borders as active constraints, and continuation over closed
 * seams and creases.
 * \ingroup surface */
class PCL_NURBS_SURFACE_EXPORT ClosestPointFinder {
public:
  explicit ClosestPointFinder(NurbsSurface surface);

  const NurbsSurface&
  surface() const;

  /** \brief The nearest of all points of the surface, to a relative 1e-10 of the
   * distance, by branch and bound on Bernstein coefficients of the squared distance;
   * one of them where several are equally near.
   * \throws std::invalid_argument if \a point is not finite */
  ClosestPoint
  find(const Eigen::Vector3d& point) const;

  /** \brief The local minimum of the distance that descent from (\a u, \a v) reaches.
   * The start is clamped to the domain. No allocation.
   * \throws std::invalid_argument if the point or the start is not finite */
  ClosestPoint
  findFrom(const Eigen::Vector3d& point, double u, double v) const;

  /** \brief Point inversion: the parameter of a point that lies on the surface.
   * \return nothing if the surface is farther than \a tolerance from \a point */
  std::optional<Eigen::Vector2d>
  invert(const Eigen::Vector3d& point, double tolerance) const;

private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

/** \brief Foot point of a point on a curve. */
template <int Dim>
struct CurveClosestPoint {
  double u = 0.0;
  typename NurbsCurve<Dim>::Point point = NurbsCurve<Dim>::Point::Zero();
  double distance = 0.0;
  bool converged = false;
  bool at_boundary = false; /**< \brief At an end (where a closed curve closes: not). */
};

/** \brief Orthogonal projection of points on a curve in the plane or in space; the
 * guarantees are those of ClosestPointFinder.
 * \ingroup surface */
template <int Dim>
class CurveClosestPointFinder {
public:
  using Point = typename NurbsCurve<Dim>::Point;

  explicit CurveClosestPointFinder(NurbsCurve<Dim> curve);

  const NurbsCurve<Dim>&
  curve() const;

  /** \brief The nearest of all points of the curve.
   * \throws std::invalid_argument if \a point is not finite */
  CurveClosestPoint<Dim>
  find(const Point& point) const;

  /** \brief The local minimum that descent from \a u reaches (equation 6.3).
   * \throws std::invalid_argument if the point or the start is not finite */
  CurveClosestPoint<Dim>
  findFrom(const Point& point, double u) const;

  /** \brief Point inversion: the parameter of a point that lies on the curve.
   * \return nothing if the curve is farther than \a tolerance from \a point */
  std::optional<double>
  invert(const Point& point, double tolerance) const;

private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

extern template class PCL_NURBS_SURFACE_EXPORT CurveClosestPointFinder<2>;
extern template class PCL_NURBS_SURFACE_EXPORT CurveClosestPointFinder<3>;

} // namespace nurbs
} // namespace pcl
