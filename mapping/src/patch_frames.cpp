// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "patch_frames.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl {
namespace nurbs {
namespace {

/** Pose whose axes are the principal ones: x along the largest extent, z along the
 * smallest and towards the sensor at the origin. */
Eigen::Isometry3d
basePlane(const Eigen::Matrix3Xd& positions)
{
  const Eigen::Vector3d mean = positions.rowwise().mean();
  const Eigen::Matrix3Xd centred = positions.colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(centred *
                                                              centred.transpose());
  Eigen::Vector3d normal = solver.eigenvectors().col(0);
  if (normal.dot(mean) > 0.0)
    normal = -normal;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = solver.eigenvectors().col(2);
  pose.linear().col(1) = normal.cross(solver.eigenvectors().col(2));
  pose.linear().col(2) = normal;
  pose.translation() = mean;
  return pose;
}

/** The sensor's axes as a camera: columns are right, down and forward. */
Eigen::Isometry3d
sensorPose(const GridGeometry& geometry)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = geometry.frame.transpose();
  return pose;
}

/** Camera at the origin that looks along the mean direction of the points. */
Eigen::Isometry3d
viewOf(const Eigen::Matrix3Xd& positions)
{
  const Eigen::Vector3d forward = positions.colwise().normalized().rowwise().mean();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), forward)
                      .toRotationMatrix();
  return pose;
}

/** Whether all points lie in a cone of 50 degrees around the axis of a view, where a
 * pinhole projection does not stretch too much. */
bool
fitsView(const Eigen::Isometry3d& pose, const Eigen::Matrix3Xd& positions)
{
  constexpr double kSmallestCosine = 0.64;
  const Eigen::RowVectorXd along = pose.linear().col(2).transpose() * positions;
  return (along.array() > kSmallestCosine * positions.colwise().norm().array()).all();
}

/** The camera's view turned so that u runs along a long, slanted segment: knots then
 * follow it instead of crossing it in a staircase. Nothing for segments that are not.
 */
std::optional<FrameCandidate>
viewAlong(const GridGeometry& geometry, const Eigen::Matrix3Xd& positions)
{
  constexpr double kLong = 1.5;     // length over width
  constexpr double kSlanted = 0.15; // radians off the image's axes
  Eigen::Isometry3d pose = sensorPose(geometry);
  const Eigen::Matrix3Xd local = pose.linear().transpose() * positions;
  const Eigen::Matrix2Xd image = local.colwise().hnormalized();
  const Eigen::Matrix2Xd centred = image.colwise() - image.rowwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(centred *
                                                              centred.transpose());
  const Eigen::Vector2d axis = solver.eigenvectors().col(1);
  const double smallest = axis.cwiseAbs().minCoeff();
  if (solver.eigenvalues()(1) < kLong * kLong * solver.eigenvalues()(0) ||
      smallest < std::sin(kSlanted))
    return std::nullopt;
  pose.rotate(
      Eigen::AngleAxisd(std::atan2(axis.y(), axis.x()), Eigen::Vector3d::UnitZ()));
  const double focal = geometry.intrinsics().fx;
  return FrameCandidate{HeightFieldFrame::perspective(focal, focal, 0.0, 0.0, pose),
                        CornerRule::View,
                        {}};
}

FrameCandidate
pixels(const GridGeometry& geometry)
{
  const PinholeIntrinsics camera = geometry.intrinsics();
  return {HeightFieldFrame::perspective(
              camera.fx, camera.fy, camera.cx, camera.cy, sensorPose(geometry)),
          CornerRule::Grid,
          {}};
}

/** Pinhole view along the mean direction, if that holds the points. */
std::optional<FrameCandidate>
viewInto(const Eigen::Matrix3Xd& positions)
{
  const Eigen::Isometry3d view = viewOf(positions);
  if (!fitsView(view, positions))
    return std::nullopt;
  return FrameCandidate{
      HeightFieldFrame::perspective(1.0, 1.0, 0.0, 0.0, view), CornerRule::View, {}};
}

HeightFieldFrame
mapPlane(const GridGeometry& geometry)
{
  Eigen::Isometry3d pose = sensorPose(geometry);
  pose.linear().col(1) = pose.linear().col(2).cross(pose.linear().col(0));
  return HeightFieldFrame::plane(pose);
}

/** Slab of the largest sheet of a segment. Sheets of a segment are large and bend a
 * little: the slab is as thick as a share of the segment's extent. */
Slab
slabOf(const Eigen::Matrix3Xd& positions, double noise)
{
  constexpr double kSigmas = 4.0;
  constexpr double kShare = 0.02; // of the standard deviation of the points
  const Eigen::Vector3d mean = positions.rowwise().mean();
  const double spread = std::sqrt((positions.colwise() - mean).squaredNorm() /
                                  static_cast<double>(positions.cols()));
  return robustSlab(positions, std::max(kSigmas * noise, kShare * spread));
}

/** Base plane of the points in a slab. */
HeightFieldFrame
planeIn(const Slab& slab, const Eigen::Matrix3Xd& positions)
{
  Eigen::Matrix3Xd inside(3, positions.cols());
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k < positions.cols(); ++k)
    if (slab.contains(positions.col(k)))
      inside.col(count++) = positions.col(k);
  return HeightFieldFrame::plane(
      basePlane(count < 3 ? positions : Eigen::Matrix3Xd(inside.leftCols(count))));
}

/** Plane of all points: a map's own one, otherwise their base plane. */
FrameCandidate
planeOfAll(const GridGeometry& geometry, const Eigen::Matrix3Xd& positions)
{
  const bool map = geometry.projection == GridProjection::plane;
  return {map ? mapPlane(geometry) : HeightFieldFrame::plane(basePlane(positions)),
          CornerRule::Surface,
          {}};
}

/** The same for the largest sheet. */
FrameCandidate
planeOfSheet(const GridGeometry& geometry,
             const Eigen::Matrix3Xd& positions,
             double noise)
{
  const bool map = geometry.projection == GridProjection::plane;
  const Slab slab = slabOf(positions, noise);
  return {
      map ? mapPlane(geometry) : planeIn(slab, positions), CornerRule::Surface, slab};
}

} // namespace

std::vector<FrameProposal>
proposeFrames(const GridGeometry& geometry,
              const Eigen::Matrix3Xd& positions,
              double noise)
{
  std::vector<FrameProposal> result;
  if (geometry.projection == GridProjection::perspective) {
    result.push_back({CornerRule::Grid, [&] { return pixels(geometry); }});
    result.push_back(
        {CornerRule::View, [&] { return viewAlong(geometry, positions); }});
  }
  result.push_back(
      {CornerRule::Surface, [&] { return planeOfAll(geometry, positions); }});
  result.push_back({CornerRule::Surface,
                    [&, noise] { return planeOfSheet(geometry, positions, noise); }});
  if (geometry.projection == GridProjection::spherical)
    result.push_back({CornerRule::View, [&] { return viewInto(positions); }});
  return result;
}

} // namespace nurbs
} // namespace pcl
