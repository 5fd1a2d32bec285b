// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl {
namespace nurbs {

/** \brief A projective frame in which a surface is a scalar field h(u, v).
 *
 * The homogeneous point of (u, v, h) is matrix() * (u, v, h, 1)'. Control points at the
 * Greville abscissae reproduce u and v exactly, so such a surface stores one number per
 * control point, and fitting it is a scalar linear problem. Two cases matter: - plane:
 * h is the height above a base plane, the surface is polynomial; - perspective: (u, v)
 * is the pixel of a pinhole camera and h the inverse depth, so the weights of the
 * surface are the inverse depth. A plane is then exactly linear in (u, v) and the noise
 * of h is nearly constant for a triangulating sensor.
 * \ingroup surface */
class PCL_NURBS_SURFACE_EXPORT HeightFieldFrame {
public:
  /** \brief Heights over the xy plane. */
  HeightFieldFrame();

  /** \brief Any invertible projective frame.
   * \throws std::invalid_argument if \a matrix is singular or not finite */
  explicit HeightFieldFrame(const Eigen::Matrix4d& matrix);

  /** \brief Heights over the xy plane of a frame, in metres.
   * \param[in] T_world_plane pose of the plane's frame */
  static HeightFieldFrame
  plane(const Eigen::Isometry3d& T_world_plane);

  /** \brief Inverse depth (1/m) over the pixels of a pinhole camera.
   * \param[in] fx focal length in pixels per unit of x/z
   * \param[in] fy focal length in pixels per unit of y/z
   * \param[in] cx column of the optical axis in pixels
   * \param[in] cy row of the optical axis in pixels
   * \param[in] T_world_camera pose of the camera: x right, y down, z forward */
  static HeightFieldFrame
  perspective(double fx,
              double fy,
              double cx,
              double cy,
              const Eigen::Isometry3d& T_world_camera = Eigen::Isometry3d::Identity());

  const Eigen::Matrix4d&
  matrix() const
  {
    return matrix_;
  }

  /** \brief (u, v, h) of a point in space; not finite where the frame cannot see it. */
  Eigen::Vector3d
  toLocal(const Eigen::Vector3d& point) const
  {
    const Eigen::Vector4d local = inverse_ * point.homogeneous();
    return local.head<3>() / local(3);
  }

  /** \brief Point in space of (u, v, h). */
  Eigen::Vector3d
  toWorld(const Eigen::Vector3d& local) const
  {
    const Eigen::Vector4d point = matrix_ * local.homogeneous();
    return point.head<3>() / point(3);
  }

  /** \brief Derivative of the point in space by h, at a point with weight \a weight. */
  Eigen::Vector3d
  derivativeByHeight(const Eigen::Vector3d& point, double weight) const
  {
    return (matrix_.col(2).head<3>() - matrix_(3, 2) * point) / weight;
  }

  /** \brief Surface whose height coefficients are given.
   * \param[in] knots_u knots of the first direction
   * \param[in] knots_v knots of the second direction
   * \param[in] heights coefficient of control point (i, j) at i * n_v + j
   * \throws std::domain_error if a weight would not be positive: the surface would
   * reach behind the camera */
  NurbsSurface
  surface(const KnotVector& knots_u,
          const KnotVector& knots_v,
          const Eigen::VectorXd& heights) const;

private:
  Eigen::Matrix4d matrix_;
  Eigen::Matrix4d inverse_;
};

} // namespace nurbs
} // namespace pcl
