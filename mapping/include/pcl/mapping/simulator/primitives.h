// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>
#include <pcl/surface/nurbs/conics.h>
#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Geometry>

#include <array>
#include <variant>

namespace pcl {
namespace nurbs {

/** \file
 * Bounded analytic surfaces that rays meet exactly (to rounding), and that are exact as
 * NURBS too. Lengths in metres, angles in radians. All are plain values; frames must be
 * rigid and sizes positive.
 */

/** \brief A half-line. */
struct Beam {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX(); /**< of unit length */

  Eigen::Vector3d
  at(double distance) const
  {
    return origin + distance * direction;
  }
};

/** \brief Openings in a rectangle in columns and rows: the first one's lower left
 * corner, its size, and the distances to the next; its top may be a half disc on the
 * rectangle, whose diameter is the width. */
struct OpeningGrid {
  int columns = 0;
  int rows = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  Eigen::Vector2d pitch = Eigen::Vector2d::Zero();
  bool arched = false;

  /** \brief Whether a place lies in an opening. O(1). */
  bool
  contains(double u, double v) const;
};

/** \brief Part of the plane z = 0 of a frame. */
struct PCL_NURBS_MAPPING_EXPORT PlanePatch {
  enum class Outline {
    Rectangle, /**< 0 <= x <= size_x, 0 <= y <= size_y, without the openings */
    Gable,     /**< the isosceles triangle in that rectangle, base on the x axis */
    Disc       /**< around the origin, radius size_x */
  };

  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  double size_x = 1.0;
  double size_y = 1.0;
  Outline outline = Outline::Rectangle;
  OpeningGrid openings;
};

/** \brief The surface between two parabolas (quadratic Bezier curves), ruled by
 * straight lines between equal parameters: a road with its crown, or, with straight
 * borders, a bilinear patch. */
struct RuledPatch {
  std::array<Eigen::Vector3d, 3> start;
  std::array<Eigen::Vector3d, 3> end;

  /** \brief Bilinear patch, or a flat quadrilateral. */
  static RuledPatch
  bilinear(const Eigen::Vector3d& start_left,
           const Eigen::Vector3d& start_right,
           const Eigen::Vector3d& end_left,
           const Eigen::Vector3d& end_right)
  {
    return {{start_left, 0.5 * (start_left + start_right), start_right},
            {end_left, 0.5 * (end_left + end_right), end_right}};
  }

  /** \brief The point at (u, v): u from start to end, v along the parabolas. */
  Eigen::Vector3d
  point(double u, double v) const
  {
    const double w = 1.0 - v;
    const auto along = [&](const std::array<Eigen::Vector3d, 3>& p) {
      return Eigen::Vector3d(w * w * p[0] + 2.0 * v * w * p[1] + v * v * p[2]);
    };
    return (1.0 - u) * along(start) + u * along(end);
  }
};

/** \brief Cylinder or truncated cone about the z axis of a frame, from z = 0 to z =
 * height; angles count from x. Open at its ends; met from both sides. */
struct FrustumPatch {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  double radius_bottom = 1.0;
  double radius_top = 1.0;
  double height = 1.0;
  AngleRange sweep;
};

/** \brief Zone of a sphere around the origin of a frame between two latitudes. */
struct SpherePatch {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  double radius = 1.0;
  AngleRange latitude{-M_PI_2, M_PI_2};
};

/** \brief Ring torus around the z axis of a frame, over a range of the angle about it.
 */
struct TorusPatch {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  double radius_major = 1.0;
  double radius_minor = 0.25;
  AngleRange around;
};

using Primitive =
    std::variant<PlanePatch, RuledPatch, FrustumPatch, SpherePatch, TorusPatch>;

/** \brief Distance along a ray to the first meeting between two distances (\a near >=
 * 0), infinity when there is none. O(1), no allocation. \ingroup mapping */
PCL_NURBS_MAPPING_EXPORT double
intersect(const Primitive& primitive, const Beam& ray, double near, double far);

/** \brief Unit normal at a point of the surface (of either sense). */
PCL_NURBS_MAPPING_EXPORT Eigen::Vector3d
normalAt(const Primitive& primitive, const Eigen::Vector3d& point);

/** \brief Box that holds the surface; exact for planes and ruled patches, of the whole
 * sphere, torus or frustum for parts of one. */
PCL_NURBS_MAPPING_EXPORT Eigen::AlignedBox3d
boundsOf(const Primitive& primitive);

/** \brief The same surface as a NURBS by the kernel's exact constructions. A plane
 * comes as the whole rectangle (disc: square) that holds its outline, without trimming.
 * \ingroup mapping */
PCL_NURBS_MAPPING_EXPORT NurbsSurface
toNurbs(const Primitive& primitive);

/** \brief The primitive moved by a rigid motion. */
PCL_NURBS_MAPPING_EXPORT Primitive
moved(const Primitive& primitive, const Eigen::Isometry3d& motion);

} // namespace nurbs
} // namespace pcl
