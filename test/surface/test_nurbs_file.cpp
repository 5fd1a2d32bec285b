// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Files of the project's own format: what comes back, what it costs, what is refused.

#include <pcl/surface/nurbs/nurbs_file.h>

#include "model_equality.h"
#include "random_models.h"

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;
using pcl::nurbs::test::readBytes;
using pcl::nurbs::test::TemporaryFile;

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
