// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_curve.h>
#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>

namespace pcl {
namespace nurbs {

/** \brief First (E, F, G) and second (L, M, N) fundamental form at a point. */
struct FundamentalForms {
  double e = 0.0; /**< \brief S_u . S_u */
  double f = 0.0; /**< \brief S_u . S_v */
  double g = 0.0; /**< \brief S_v . S_v */
  double l = 0.0; /**< \brief S_uu . n */
  double m = 0.0; /**< \brief S_uv . n */
  double n = 0.0; /**< \brief S_vv . n */
  /** \brief Unit normal S_u x S_v / |S_u x S_v|; zero where the product vanishes, and
   * then l, m, n are zero too. */
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/** \brief Curvatures at a point in 1 / unit of the control points. A surface that bends
 * towards its normal has positive curvature. */
struct SurfaceCurvature {
  double gaussian = 0.0;
  double mean = 0.0;
  double maximum = 0.0; /**< \brief Larger principal curvature. */
  double minimum = 0.0; /**< \brief Smaller principal curvature. */
  /** \brief Unit tangents of the principal curvatures; together with the normal they
   * are a right-handed frame (maximum, minimum, normal). At an umbilic point any such
   * pair. */
  Eigen::Vector3d maximum_direction = Eigen::Vector3d::Zero();
  Eigen::Vector3d minimum_direction = Eigen::Vector3d::Zero();
  /** \brief False where S_u and S_v are parallel or zero. The values are then those of
   * a regular point nearby towards the middle of the domain, extrapolated (the limit at
   * a pole, to about 1e-6), or all zero if there is none. */
  bool regular = false;
};

/** \brief Both fundamental forms at (u, v). O(p q), no allocation. */
PCL_NURBS_SURFACE_EXPORT FundamentalForms
fundamentalForms(const NurbsSurface& surface, double u, double v);

/** \brief Gaussian, mean and principal curvatures at (u, v). O(p q), no allocation. */
PCL_NURBS_SURFACE_EXPORT SurfaceCurvature
curvature(const NurbsSurface& surface, double u, double v);

/** \brief Area of a surface in the unit of the control points squared.
 *
 * Tensor-product Gauss-Legendre rules on every knot span, the spans with the largest
 * estimated error halved until the sum of the estimates is below the tolerance.
 * \param[in] surface surface
 * \param[in] relative_tolerance share of the area, at least 1e-13
 * \throws std::invalid_argument if the tolerance is too small or not a number */
PCL_NURBS_SURFACE_EXPORT double
surfaceArea(const NurbsSurface& surface, double relative_tolerance = 1e-9);

/** \brief Curvature of a plane curve, positive where it turns left; 0 where the first
 * derivative vanishes. */
PCL_NURBS_SURFACE_EXPORT double
curvature(const NurbsCurve2& curve, double u);

/** \brief Curvature of a curve in space, not negative; 0 where the first derivative
 * vanishes. */
PCL_NURBS_SURFACE_EXPORT double
curvature(const NurbsCurve3& curve, double u);

/** \brief Torsion of a curve in space; 0 where the curvature vanishes. */
PCL_NURBS_SURFACE_EXPORT double
torsion(const NurbsCurve3& curve, double u);

/** \brief Arc length between two parameters (negative if \a to < \a from), by adaptive
 * Gauss-Legendre quadrature on every knot span.
 * \throws std::invalid_argument if a parameter is outside of the domain or the
 * tolerance is below 1e-13 */
template <int Dim>
double
arcLength(const NurbsCurve<Dim>& curve,
          double from,
          double to,
          double relative_tolerance = 1e-9);

/** \brief Length of the whole curve. */
template <int Dim>
double
arcLength(const NurbsCurve<Dim>& curve, double relative_tolerance = 1e-9);

extern template PCL_NURBS_SURFACE_EXPORT double
arcLength<2>(const NurbsCurve<2>&, double, double, double);
extern template PCL_NURBS_SURFACE_EXPORT double
arcLength<3>(const NurbsCurve<3>&, double, double, double);
extern template PCL_NURBS_SURFACE_EXPORT double
arcLength<2>(const NurbsCurve<2>&, double);
extern template PCL_NURBS_SURFACE_EXPORT double
arcLength<3>(const NurbsCurve<3>&, double);

} // namespace nurbs
} // namespace pcl
