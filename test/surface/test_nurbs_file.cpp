// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Files of the project's own format: what comes back, what it costs, what is refused.

#include <pcl/surface/nurbs/nurbs_file.h>

#include "model_equality.h"
#include "random_models.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;
using pcl::nurbs::test::TemporaryFile;
using Bytes = std::vector<std::uint8_t>;

Bytes
readBytes(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

SurfaceModel
roundTrip(const SurfaceModel& model, const NurbsFileOptions& options)
{
  const TemporaryFile file("_trip.nurbs");
  writeNurbsFile(file.path(), model, options);
  return readNurbsFile(file.path());
}

NurbsFileOptions
lossless()
{
  NurbsFileOptions options;
  options.lossless = true;
  return options;
}

TEST(NurbsFile, losslessKeepsEveryBit)
{
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const SurfaceModel model = test::randomModel(seed, 12);
    test::expectIdentical(roundTrip(model, lossless()), model);
  }
}

TEST(NurbsFile, emptyModelComesBack)
{
  SurfaceModel model;
  test::expectIdentical(roundTrip(model, {}), model);
}

TEST(NurbsFile, quantisedKeepsIdentityAndCurvedTrims)
{
  const SurfaceModel model = test::randomModel(5, 30);
  const SurfaceModel read = roundTrip(model, {});
  EXPECT_EQ(read.frame_id, model.frame_id);
  EXPECT_EQ(read.metadata, model.metadata);
  ASSERT_EQ(read.patches.size(), model.patches.size());
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    const SurfacePatch& before = model.patches[i];
    const SurfacePatch& after = read.patches[i];
    EXPECT_EQ(after.label, before.label);
    EXPECT_EQ(after.quality.points, before.quality.points);
    EXPECT_NEAR(after.quality.rmse, before.quality.rmse, 0.04 * before.quality.rmse);
    EXPECT_EQ(after.geometry.loops().size(), before.geometry.loops().size());
  }
  const TrimLoop& curved = model.patches[2].geometry.loops()[1];
  test::expectIdentical(read.patches[2].geometry.loops()[1], curved);
}

/** Surface points move by no more than the step allows, at equal shares of the domain
 * (the domain itself may be rounded). */
TEST(NurbsFile, quantisedSurfaceStaysWithinTheStep)
{
  RandomNurbs random(3);
  NurbsFileOptions options;
  for (double step : {1e-2, 1e-4, 1e-7}) {
    options.step = step;
    const SurfaceModel model = test::randomModel(11, 40);
    const SurfaceModel read = roundTrip(model, options);
    for (std::size_t i = 0; i < model.patches.size(); ++i) {
      const NurbsSurface& before = model.patches[i].geometry.surface();
      const NurbsSurface& after = read.patches[i].geometry.surface();
      for (int n = 0; n < 50; ++n) {
        const double s = random.uniform(0.0, 1.0);
        const double t = random.uniform(0.0, 1.0);
        const auto at = [&](const NurbsSurface& surface) {
          return surface.evaluate(
              surface.knotsU().domainMin() + s * surface.knotsU().domainLength(),
              surface.knotsV().domainMin() + t * surface.knotsV().domainLength());
        };
        EXPECT_LT((at(after) - at(before)).norm(), 2.0 * step) << "patch " << i;
      }
    }
  }
}

/** The promise of NurbsFileOptions: root mean square distance grows by less than 10 %.
 * Points are made with the stated noise beside the surface. */
TEST(NurbsFile, quantisationAddsLessThanTenPercentToRmse)
{
  RandomNurbs random(7);
  double before = 0.0;
  double after = 0.0;
  for (double noise : {0.02, 0.002}) {
    SurfaceModel model;
    for (int i = 0; i < 30; ++i) {
      SurfacePatch patch;
      const Eigen::Affine3d pose = test::rigidPose(random);
      patch.geometry = TrimmedSurface(
          i % 2 == 0
              ? test::heightField(pose)
              : NurbsSurface::fromControlPoints(
                    KnotVector::bezier(1, -2, 2),
                    KnotVector::bezier(1, -1, 1),
                    (Eigen::Matrix3Xd(3, 4) << -2, -2, 2, 2, -1, 1, -1, 1, 0, 0, 0, 0)
                        .finished())
                    .transformed(pose));
      patch.quality.rmse = noise;
      model.patches.push_back(patch);
    }
    const SurfaceModel read = roundTrip(model, {});
    for (std::size_t i = 0; i < model.patches.size(); ++i) {
      const NurbsSurface& surface = model.patches[i].geometry.surface();
      const NurbsSurface& coded = read.patches[i].geometry.surface();
      for (int n = 0; n < 2000; ++n) {
        const double u = random.inDomain(surface.knotsU());
        const double v = random.inDomain(surface.knotsV());
        const Eigen::Vector3d normal = surface.normal(u, v);
        const double beside = random.normal(noise);
        const double moved =
            normal.dot(surface.evaluate(u, v) - coded.evaluate(u, v)) + beside;
        before += beside * beside / (noise * noise);
        after += moved * moved / (noise * noise);
      }
    }
  }
  const double growth = std::sqrt(after / before) - 1.0;
  RecordProperty("growth", std::to_string(growth));
  EXPECT_LT(growth, 0.1);
  EXPECT_GT(growth, 0.0); // it is a lossy mode, or this test does not test it
}

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
  SurfaceModel model;
  model.patches = {patch};
  test::expectIdentical(roundTrip(model, lossless()), model);
}

TEST(NurbsFile, quantisedPolygonStaysOnItsSpacing)
{
  const SurfaceModel model = test::randomModel(21, 60);
  NurbsFileOptions options;
  options.step = 1e-3;
  const SurfaceModel read = roundTrip(model, options);
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    if (i % 3 != 1)
      continue;
    const auto& before = model.patches[i].geometry.loops()[0];
    const auto& after = read.patches[i].geometry.loops()[0];
    const auto corners = before.flattened(1e-9);
    const auto moved = after.flattened(1e-9);
    ASSERT_EQ(moved.size(), corners.size());
    for (std::size_t k = 0; k < corners.size(); ++k)
      EXPECT_LT((moved[k] - corners[k]).norm(), 4e-3);
    EXPECT_GT(after.signedArea() * before.signedArea(), 0.0);
  }
}

TEST(NurbsFile, degeneratePatchesSurviveTheLossyMode)
{
  SurfaceModel model;
  const KnotVector u = KnotVector::clampedUniform(2, 3);
  const KnotVector v = KnotVector::clamped(3, {0.0, 1e-7, 0.3, 1.0});
  const int count = u.numControlPoints() * v.numControlPoints();
  for (double scale : {0.0, 1e-12, 1.0, 1e9}) {
    RandomNurbs random(4);
    Eigen::Matrix3Xd points(3, count);
    for (int i = 0; i < count; ++i)
      points.col(i) << scale * random.uniform(-1, 1), scale * 0.5, 0.0;
    SurfacePatch patch;
    patch.geometry = TrimmedSurface(NurbsSurface::fromControlPoints(u, v, points));
    patch.quality.rmse = 1e-3;
    model.patches.push_back(patch);
  }
  const SurfaceModel read = roundTrip(model, {});
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    const auto& before = model.patches[i].geometry.surface();
    const auto& after = read.patches[i].geometry.surface();
    ASSERT_EQ(after.numControlPoints(), before.numControlPoints());
    for (int k = 0; k < u.numControlPoints(); ++k)
      for (int l = 0; l < v.numControlPoints(); ++l)
        EXPECT_LT((after.controlPoint(k, l) - before.controlPoint(k, l)).norm(), 2e-3);
  }
}

TEST(NurbsFile, optionsAreChecked)
{
  const TemporaryFile file("_options.nurbs");
  for (auto spoil : {+[](NurbsFileOptions& o) { o.rmse_share = 0.0; },
                     +[](NurbsFileOptions& o) { o.step = -1.0; },
                     +[](NurbsFileOptions& o) { o.default_step = 0.0; },
                     +[](NurbsFileOptions& o) { o.trim_factor = std::nan(""); }}) {
    NurbsFileOptions options;
    spoil(options);
    EXPECT_THROW(writeNurbsFile(file.path(), test::randomModel(1, 1), options),
                 std::invalid_argument);
    EXPECT_FALSE(std::filesystem::exists(file.path()));
  }
}

TEST(NurbsFile, unwritablePathIsNamed)
{
  EXPECT_THROW(writeNurbsFile("/no/such/folder/x.nurbs", {}), std::runtime_error);
  EXPECT_THROW(NurbsFileWriter("/no/such/folder/x.nurbs", "map"), std::runtime_error);
}

/** The bytes of the format must not change unnoticed: a file that was written once is
 * read to the values it was made from. */
TEST(NurbsFileGolden, isReadToItsValues)
{
  const std::string folder = PCL_NURBS_TEST_DATA;
  const SurfaceModel exact = readNurbsFile(folder + "/golden_lossless.nurbs");
  test::expectIdentical(exact, test::goldenModel());
  const SurfaceModel coded = readNurbsFile(folder + "/golden_quantised.nurbs");
  ASSERT_EQ(coded.patches.size(), exact.patches.size());
  for (std::size_t i = 0; i < exact.patches.size(); ++i) {
    const auto& before = exact.patches[i].geometry.surface();
    const auto& after = coded.patches[i].geometry.surface();
    for (int k = 0; k < before.numControlPointsU(); ++k)
      for (int l = 0; l < before.numControlPointsV(); ++l)
        EXPECT_LT((after.controlPoint(k, l) - before.controlPoint(k, l)).norm(), 2e-3);
  }
}

TEST(NurbsFileGolden, isWrittenByteByByte)
{
  const std::string folder = PCL_NURBS_TEST_DATA;
  const TemporaryFile file("_golden.nurbs");
  writeNurbsFile(file.path(), test::goldenModel(), lossless());
  EXPECT_EQ(readBytes(file.path()), readBytes(folder + "/golden_lossless.nurbs"));
  NurbsFileOptions options;
  options.step = 1e-3;
  writeNurbsFile(file.path(), test::goldenModel(), options);
  EXPECT_EQ(readBytes(file.path()), readBytes(folder + "/golden_quantised.nurbs"));
}

} // namespace
