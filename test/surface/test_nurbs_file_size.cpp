// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// What the classes of patches and trims cost in the native format.

#include <pcl/surface/nurbs/nurbs_file.h>

#include "model_equality.h"
#include "random_models.h"

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;

std::size_t
patchBytes(const NurbsSurface& surface, double step)
{
  SurfacePatch patch;
  patch.geometry = TrimmedSurface(surface);
  NurbsFileOptions options;
  options.step = step;
  return encodePatches({patch}, options).size();
}

TEST(NurbsFileSize, heightFieldCostsOneScalarPerControlPoint)
{
  RandomNurbs random(9);
  const NurbsSurface surface = test::heightField(test::rigidPose(random));
  const std::size_t bytes = patchBytes(surface, 1e-3);
  RecordProperty("bytes", static_cast<int>(bytes));
  ASSERT_EQ(surface.numControlPoints(), 400);
  EXPECT_LT(bytes, 800U);
  // Shear and unequal scales make the frame dearer, not the control points.
  Eigen::Affine3d sheared = test::rigidPose(random);
  sheared.linear() *= Eigen::Vector3d(1.0, 2.0, 1.0).asDiagonal();
  sheared.linear().col(0) += 0.3 * sheared.linear().col(1);
  EXPECT_LT(patchBytes(test::heightField(sheared), 1e-3), 2 * bytes);
}

TEST(NurbsFileSize, planeCostsItsFrame)
{
  RandomNurbs random(10);
  const NurbsSurface plane =
      NurbsSurface::fromControlPoints(
          KnotVector::bezier(1, -2, 2),
          KnotVector::bezier(1, -1, 1),
          (Eigen::Matrix3Xd(3, 4) << -2, -2, 2, 2, -1, 1, -1, 1, 0, 0, 0, 0).finished())
          .transformed(test::rigidPose(random));
  EXPECT_LT(patchBytes(plane, 0.02), 40U);
  std::vector<SurfacePatch> patches(200);
  NurbsFileOptions options;
  options.step = 0.02;
  for (SurfacePatch& patch : patches)
    patch.geometry = TrimmedSurface(plane.transformed(test::rigidPose(random)));
  const std::size_t bytes = encodePatches(patches, options).size();
  RecordProperty("bytes_of_200", static_cast<int>(bytes));
  EXPECT_LT(bytes, 200U * 14U);
}

/** Patch over pixels: rays of a pinhole camera, inverse depth as weight. */
NurbsSurface
perspectivePatch(const Eigen::Affine3d& pose)
{
  const KnotVector u = KnotVector::clampedUniform(3, 17, 100.0, 440.0);
  const KnotVector v = KnotVector::clampedUniform(3, 17, 60.0, 400.0);
  NurbsSurface::HomogeneousPoints points(4,
                                         u.numControlPoints() * v.numControlPoints());
  for (int i = 0, column = 0; i < u.numControlPoints(); ++i)
    for (int j = 0; j < v.numControlPoints(); ++j, ++column) {
      const double x = (u.greville(i) - 320.0) / 525.0;
      const double y = (v.greville(j) - 240.0) / 525.0;
      points.col(column) << x, y, 1.0,
          0.5 + 0.1 * x + 0.05 * std::sin(8.0 * x) * std::cos(6.0 * y);
    }
  return NurbsSurface(u, v, std::move(points)).transformed(pose);
}

TEST(NurbsFileSize, perspectivePatchCostsOneScalarPerControlPoint)
{
  RandomNurbs random(12);
  for (const Eigen::Affine3d& pose :
       {Eigen::Affine3d::Identity(), test::rigidPose(random)}) {
    const NurbsSurface surface = perspectivePatch(pose);
    SurfacePatch patch;
    patch.geometry = TrimmedSurface(surface);
    NurbsFileOptions options;
    options.step = 1e-3;
    const std::size_t one = encodePatches({patch}, options).size();
    const std::size_t ten =
        encodePatches(std::vector<SurfacePatch>(10, patch), options).size();
    RecordProperty("bytes", static_cast<int>(one));
    EXPECT_LT(one, 800U);
    EXPECT_LT(ten - one, 9U * 600U); // the camera is stored once
    std::uint64_t numbers = 1U << 20;
    const NurbsSurface coded = decodePatches(encodePatches({patch}, options), numbers)
                                   .front()
                                   .geometry.surface();
    double squares = 0.0;
    for (int n = 0; n < 1000; ++n) {
      const double u = random.inDomain(surface.knotsU());
      const double v = random.inDomain(surface.knotsV());
      squares += (coded.evaluate(u, v) - surface.evaluate(u, v)).squaredNorm();
    }
    EXPECT_LT(std::sqrt(squares / 1000), 0.5 * options.step);
    EXPECT_GT(squares, 0.0);
  }
}

TEST(NurbsFileSize, pixelMaskIsAChainCode)
{
  // Border of a disc of pixels, one corner per step.
  const NurbsSurface surface = NurbsSurface::fromControlPoints(
      KnotVector::bezier(1, -0.5, 639.5),
      KnotVector::bezier(1, -0.5, 479.5),
      (Eigen::Matrix3Xd(3, 4) << 0, 0, 1, 1, 0, 1, 0, 1, 0, 0, 0, 0).finished());
  std::vector<Eigen::Vector2d> corners;
  for (int row = 0; row < 200; ++row) {
    const double half = std::floor(std::sqrt(100.0 * 100.0 - std::pow(row - 99.5, 2)));
    corners.emplace_back(319.5 + half, 100.5 + row);
    corners.emplace_back(319.5 + half, 101.5 + row);
  }
  for (int row = 199; row >= 0; --row) {
    const double half = std::floor(std::sqrt(100.0 * 100.0 - std::pow(row - 99.5, 2)));
    corners.emplace_back(319.5 - half, 101.5 + row);
    corners.emplace_back(319.5 - half, 100.5 + row);
  }
  const TrimLoop loop = TrimLoop::polygon(corners);
  SurfacePatch patch;
  NurbsFileOptions options;
  options.step = 1e-4;
  patch.geometry = TrimmedSurface(surface);
  const std::size_t bare = encodePatches({patch}, options).size();
  patch.geometry = TrimmedSurface(surface, {loop});
  const std::size_t bytes = encodePatches({patch}, options).size() - bare;
  RecordProperty("bytes_of_800_corners", static_cast<int>(bytes));
  EXPECT_LT(bytes, 280U); // 8 * bytes / 800 corners: under 3 bits each
  options.lossless = true;
  std::uint64_t numbers = 10000;
  const auto read = decodePatches(encodePatches({patch}, options), numbers);
  test::expectIdentical(read.front(), patch);
}

} // namespace
