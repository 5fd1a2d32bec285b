// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/fit_options.h>
#include <pcl/surface/nurbs/height_field_frame.h>
#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Knots of u and of v. */
using SurfaceKnots = std::pair<KnotVector, KnotVector>;

/** \brief Points to fit and what is known of them. */
struct FitPoints {
  Eigen::Matrix3Xd positions;  /**< metres */
  Eigen::Matrix2Xd parameters; /**< (u, v); not needed by fits in a HeightFieldFrame */
  Eigen::VectorXd sigma;       /**< standard deviation of each, metres; empty means that
                                    all are alike and unknown */
};

/** \brief A fitted surface, the report, and the parameters of the nearest points. */
struct SurfaceFit {
  NurbsSurface surface;
  FitReport report;
  Eigen::Matrix2Xd parameters; /**< (u, v) of the foot point of each point */
};

/** \brief One border of a surface: where u or v is smallest or largest. */
enum class Border { UMin, UMax, VMin, VMax };

/** \brief How a surface continues its neighbour. */
enum class Continuity {
  C0, /**< same border curve */
  G1  /**< and the same tangent planes along it */
};

/** \brief Condition that a border of the fitted surface continues a neighbour.
 *
 * The knots along both borders must be equal (knot_operations.h makes them so). */
struct BorderConstraint {
  Border border = Border::UMin;
  NurbsSurface neighbour;
  Border neighbour_border = Border::UMax; /**< same sense of the common direction */
  Continuity continuity = Continuity::C0;
};

/** \brief Rectangle of parameters that holds all points. */
struct ParameterBox {
  Eigen::Vector2d low;
  Eigen::Vector2d high;

  /** \brief Smallest box of the columns, widened where it would have no extent. */
  static ParameterBox
  around(const Eigen::Matrix2Xd& parameters);
};

/** \brief Fit a scalar field in a projective frame, with given knots.
 *
 * A linear problem in the heights, then (FitDistance::Orthogonal) the orthogonal
 * distances by Ceres. Alternating is the same as Orthogonal here, a height field has no
 * other freedom. Time is linear in the points and does not touch them in the solver.
 * \param[in] frame maps (u, v, h) to space; perspective frames give rational surfaces
 * \param[in] knots_u knots of the first direction
 * \param[in] knots_v knots of the second direction
 * \param[in] points points; their parameters are found by the frame
 * \param[in] options how to fit
 * \throws std::invalid_argument for no points, values that are not finite or bad
 * options
 * \throws std::domain_error if the result would reach behind the camera */
PCL_NURBS_SURFACE_EXPORT SurfaceFit
fitHeightField(const HeightFieldFrame& frame,
               const KnotVector& knots_u,
               const KnotVector& knots_v,
               const FitPoints& points,
               const SurfaceFitOptions& options);

/** \brief Degrees and knots for a scalar field, found where the points show salient
 * structure (see KnotSearchOptions).
 * \param[in] frame maps (u, v, h) to space
 * \param[in] points points
 * \param[in] options limits and criterion
 * \param[out] report criterion and remaining salient regions are set
 * \param[in] start result of an earlier search over the same points to go on from; null
 *            to begin with one bilinear span
 * \return knots of u and v over the box of the points' parameters */
PCL_NURBS_SURFACE_EXPORT SurfaceKnots
chooseHeightFieldKnots(const HeightFieldFrame& frame,
                       const FitPoints& points,
                       const KnotSearchOptions& options,
                       FitReport& report,
                       const SurfaceKnots* start = nullptr);

/** \brief Fit all coordinates with given knots and parameters.
 * \param[in] knots_u knots of the first direction
 * \param[in] knots_v knots of the second direction
 * \param[in] points points with parameters
 * \param[in] options how to fit
 * \param[in] constraints borders that continue other surfaces
 * \param[in] weights NURBS weight of each control point (v fastest); empty for 1 */
PCL_NURBS_SURFACE_EXPORT SurfaceFit
fitParametric(const KnotVector& knots_u,
              const KnotVector& knots_v,
              const FitPoints& points,
              const SurfaceFitOptions& options,
              const std::vector<BorderConstraint>& constraints = {},
              const Eigen::VectorXd& weights = Eigen::VectorXd());

/** \brief Degrees and knots for points with parameters, as for a scalar field. */
PCL_NURBS_SURFACE_EXPORT SurfaceKnots
chooseParametricKnots(const FitPoints& points,
                      const KnotSearchOptions& options,
                      FitReport& report);

/** \brief Fit control points and weights to the orthogonal distances, from a first
 * surface of the wanted degrees and knots. A quadric or torus with exact points is
 * found exactly.
 * \param[in] start surface to start from
 * \param[in] points points with parameters on \a start
 * \param[in] options how to fit; distance is orthogonal */
PCL_NURBS_SURFACE_EXPORT SurfaceFit
fitRational(const NurbsSurface& start,
            const FitPoints& points,
            const SurfaceFitOptions& options);

/** \brief Orthogonal distance and foot point of points whose parameters are nearly
 * right.
 * \param[in] surface surface
 * \param[in] positions points, metres
 * \param[in,out] parameters starts, then foot points
 * \param[in] threads number of threads
 * \param[in] last_step share of the domain; a step of Gauss and Newton shorter than it
 *            is the last one: the distance is off by the square of its length times the
 *            curvature
 * \return distance of each, positive on the side of the normal S_u x S_v, metres */
PCL_NURBS_SURFACE_EXPORT Eigen::VectorXd
orthogonalDistances(const NurbsSurface& surface,
                    const Eigen::Matrix3Xd& positions,
                    Eigen::Matrix2Xd& parameters,
                    int threads = 1,
                    double last_step = 1e-6);

} // namespace nurbs
} // namespace pcl
