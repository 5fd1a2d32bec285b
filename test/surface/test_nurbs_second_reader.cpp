// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The Python reader that was written from the description of the format alone gives the
// same model, so the description says what the code does.

#include <pcl/surface/nurbs/json_io.h>
#include <pcl/surface/nurbs/nurbs_file.h>

#include "random_models.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;
using pcl::nurbs::test::TemporaryFile;

SurfaceModel
readByPython(const std::string& path)
{
  const TemporaryFile json("_second.json");
  const std::string command = "python3 '" PCL_NURBS_TEST_DATA "/read_nurbs.py' '" +
                              path + "' > '" + json.path() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return readJsonFile(json.path());
}

void
expectSame(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  ASSERT_EQ(a.cols(), b.cols());
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-13 * b.cwiseAbs().maxCoeff());
}

void
expectSame(const KnotVector& a, const KnotVector& b)
{
  ASSERT_EQ(a.degree(), b.degree());
  ASSERT_EQ(a.size(), b.size());
  for (int i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a[i], b[i], 1e-14 * (1.0 + std::abs(b[i])));
}

void
expectSame(const SurfacePatch& a, const SurfacePatch& b)
{
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.quality.points, b.quality.points);
  EXPECT_EQ(a.quality.rmse, b.quality.rmse);
  const NurbsSurface& surface = b.geometry.surface();
  expectSame(a.geometry.surface().knotsU(), surface.knotsU());
  expectSame(a.geometry.surface().knotsV(), surface.knotsV());
  expectSame(a.geometry.surface().homogeneousPoints(), surface.homogeneousPoints());
  ASSERT_EQ(a.geometry.loops().size(), b.geometry.loops().size());
  for (std::size_t i = 0; i < b.geometry.loops().size(); ++i) {
    const auto& loop = b.geometry.loops()[i].curves();
    ASSERT_EQ(a.geometry.loops()[i].curves().size(), loop.size());
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const NurbsCurve2& curve = a.geometry.loops()[i].curves()[k];
      expectSame(curve.knots(), loop[k].knots());
      expectSame(curve.homogeneousPoints(), loop[k].homogeneousPoints());
    }
  }
}

SurfaceModel
modelOfAllKinds()
{
  RandomNurbs random(2);
  SurfaceModel model = test::randomModel(31, 24);
  for (int i = 0; i < 3; ++i) {
    SurfacePatch patch;
    patch.geometry = TrimmedSurface(test::heightField(test::rigidPose(random), 5));
    model.patches.push_back(patch);
  }
  for (const SurfacePatch& patch : test::goldenModel().patches)
    model.patches.push_back(patch);
  return model;
}

TEST(NurbsSecondReader, agrees)
{
  if (std::system("python3 -c pass") != 0)
    GTEST_SKIP() << "python3 is not there";
  const SurfaceModel model = modelOfAllKinds();
  const TemporaryFile file("_second.nurbs");
  NurbsFileOptions options;
  for (bool lossless : {false, true}) {
    options.lossless = lossless;
    writeNurbsFile(file.path(), model, options);
    const SurfaceModel ours = readNurbsFile(file.path());
    const SurfaceModel theirs = readByPython(file.path());
    EXPECT_EQ(theirs.frame_id, ours.frame_id);
    ASSERT_EQ(theirs.patches.size(), ours.patches.size());
    for (std::size_t i = 0; i < ours.patches.size(); ++i)
      expectSame(theirs.patches[i], ours.patches[i]);
  }
}

} // namespace
