// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/height_field_frame.h>

#include <Eigen/LU>

#include <limits>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {

HeightFieldFrame::HeightFieldFrame()
    : matrix_(Eigen::Matrix4d::Identity()), inverse_(Eigen::Matrix4d::Identity())
{
}

HeightFieldFrame::HeightFieldFrame(const Eigen::Matrix4d& matrix) : matrix_(matrix)
{
  // A pose far from the origin has entries of very different size but is no less
  // invertible: only a pivot of zero counts.
  Eigen::FullPivLU<Eigen::Matrix4d> lu(matrix);
  lu.setThreshold(std::numeric_limits<double>::min());
  if (!matrix.allFinite() || !lu.isInvertible())
    throw std::invalid_argument("HeightFieldFrame: the frame is singular");
  inverse_ = lu.inverse();
}

HeightFieldFrame
HeightFieldFrame::plane(const Eigen::Isometry3d& T_world_plane)
{
  return HeightFieldFrame(T_world_plane.matrix());
}

HeightFieldFrame
HeightFieldFrame::perspective(
    double fx, double fy, double cx, double cy, const Eigen::Isometry3d& T_world_camera)
{
  Eigen::Matrix4d camera; // (u, v, h, 1) -> ((u - cx) / fx, (v - cy) / fy, 1, h)
  camera << 1.0 / fx, 0, 0, -cx / fx, //
      0, 1.0 / fy, 0, -cy / fy,       //
      0, 0, 0, 1,                     //
      0, 0, 1, 0;
  return HeightFieldFrame(T_world_camera.matrix() * camera);
}

NurbsSurface
HeightFieldFrame::surface(const KnotVector& knots_u,
                          const KnotVector& knots_v,
                          const Eigen::VectorXd& heights) const
{
  const int n_v = knots_v.numControlPoints();
  NurbsSurface::HomogeneousPoints points(4, heights.size());
  for (Eigen::Index k = 0; k < heights.size(); ++k) {
    const int i = static_cast<int>(k) / n_v;
    const int j = static_cast<int>(k) % n_v;
    points.col(k) =
        matrix_ *
        Eigen::Vector4d(knots_u.greville(i), knots_v.greville(j), heights(k), 1.0);
  }
  if (!(points.row(3).minCoeff() > 0.0))
    throw std::domain_error("HeightFieldFrame: the surface reaches behind the camera");
  return {knots_u, knots_v, std::move(points)};
}

} // namespace nurbs
} // namespace pcl
