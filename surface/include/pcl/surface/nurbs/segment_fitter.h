// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/surface_fitter.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief How points get their (u, v). */
enum class Parameterization {
  Auto,     /**< the camera if one is given; else the plane if the points are a height
                 field over it; else the grid of an organized cloud, or a cylinder */
  Grid,     /**< u = column and v = row of an organized cloud */
  Plane,    /**< heights over the plane of largest extent (PCA), in metres */
  Cylinder, /**< angle about and height along an axis */
  Perspective, /**< pixels of a pinhole camera, fitted in inverse depth */
  Given        /**< one (u, v) per point */
};

/** \brief A pinhole camera: u = fx x / z + cx, v = fy y / z + cy. */
struct PinholeCamera {
  double fx = 0.0; /**< focal length in pixels */
  double fy = 0.0;
  double cx = 0.0; /**< optical axis in pixels */
  double cy = 0.0;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

/** \brief Local planes through the neighbourhoods of some of the points. */
struct LocalPlanes {
  Eigen::Matrix3Xd centres;
  Eigen::Matrix3Xd normals; /**< unit vectors of arbitrary sign */
  double sigma =
      0.0; /**< standard deviation of the points around the surface, metres */
};

/** \brief One segment of a cloud. */
struct SegmentPoints {
  FitPoints points;   /**< parameters are those of Grid or Given, if there are any */
  LocalPlanes planes; /**< needed by Auto and Cylinder, may be empty for the others */
};

/** \brief Everything about a fit that can be chosen or fixed. */
struct SegmentFitOptions {
  Parameterization parameterization = Parameterization::Auto;
  std::optional<PinholeCamera> camera;
  std::optional<Eigen::Isometry3d>
      base;             /**< plane: its xy plane; cylinder: z axis, angle 0 on x */
  bool closed = false;  /**< cylinder: a full turn whose ends meet */
  bool adaptive = true; /**< search what is not fixed below; else one span */
  int degree_u = 0;     /**< fixed degree; 0: searched, or 3 without search */
  int degree_v = 0;
  std::optional<KnotVector> knots_u; /**< fixed knots, mapped to the parameters' box */
  std::optional<KnotVector> knots_v;
  bool optimize_weights = false; /**< let the weights move as well at the end */
  KnotSearchOptions search;
  SurfaceFitOptions fit;
  std::vector<BorderConstraint> constraints;
};

/** \brief A right circular cylinder. */
struct CylinderAxis {
  Eigen::Isometry3d frame; /**< z is the axis */
  double radius = 0.0;     /**< metres */
};

/** \brief Fit a local plane and quadric to each neighbourhood.
 * \param[in] neighbourhoods at least one; columns are points in metres, at least 9 each
 * \return planes; sigma is the median over the neighbourhoods that have an extent */
PCL_NURBS_SURFACE_EXPORT LocalPlanes
localPlanes(const std::vector<Eigen::Matrix3Xd>& neighbourhoods);

/** \brief Cylinder through points: axis from the normals (robustly), then all by robust
 * least squares of the distances (Ceres). O(points) per iteration.
 * \throws std::domain_error if the points do not determine a cylinder */
PCL_NURBS_SURFACE_EXPORT CylinderAxis
fitCylinderAxis(const Eigen::Matrix3Xd& points, const LocalPlanes& planes);

/** \brief Parameterise, choose degrees and knots, and fit.
 *
 * Cylinder: u is the parameter of an exact rational arc, and the fit keeps its weights,
 * so points of a circular cylinder give exactly that.
 * \throws std::invalid_argument for bad points or options, std::domain_error if the
 * points cannot be fitted that way */
PCL_NURBS_SURFACE_EXPORT SurfaceFit
fitSegment(const SegmentPoints& segment, const SegmentFitOptions& options);

} // namespace nurbs
} // namespace pcl
