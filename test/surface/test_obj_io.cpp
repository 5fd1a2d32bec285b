// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/obj_io.h>

#include "model_equality.h"
#include "random_models.h"

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;

/** Quarter of a cylinder over [0, 1] x [0, 2], written by hand, with a hole. */
const char* const kQuarterCylinder = R"(# by hand
v 1 0 0 1
v 1 1 0 0.70710678118654757
v 0 1 0 1
v 1 0 2
v 1 1 2 0.70710678118654757
v 0 1 2 1
vp 0.25 0.5
vp 0.25 1.5
vp 0.75 1.5
vp 0.75 0.5
cstype bspline
deg 1
curv2 -4 -3 -2 -1 -4
parm u 0 0 1 2 3 4 4
end
g label_42
cstype rat bspline
deg 2 1
surf 0 1 0 2 1 2 3 \
 4 5 6
parm u 0 0 0 1 1 1
parm v 0 0 2 2
hole 0 4 1
end
f 1 2 3
)";

std::string
problemOf(const std::string& from, const std::string& to)
{
  std::string text = kQuarterCylinder;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  try {
    static_cast<void>(fromObj(text.replace(at, from.size(), to)));
  } catch (const ObjIoError& error) {
    return error.what();
  }
  return "none";
}

TEST(ObjIo, handWrittenSurfaceIsRead)
{
  const SurfaceModel model = fromObj(kQuarterCylinder);
  ASSERT_EQ(model.patches.size(), 1U);
  EXPECT_EQ(model.patches[0].label, 42U);
  const TrimmedSurface& geometry = model.patches[0].geometry;
  for (double u : {0.0, 0.3, 0.9})
    for (double v : {0.0, 1.1, 2.0}) {
      const Eigen::Vector3d point = geometry.surface().evaluate(u, v);
      EXPECT_NEAR(point.head<2>().norm(), 1.0, 1e-15);
      EXPECT_NEAR(point.z(), v, 1e-15);
    }
  ASSERT_EQ(geometry.loops().size(), 1U);
  EXPECT_NEAR(geometry.loops()[0].signedArea(), -0.5, 1e-15); // clockwise
}

TEST(ObjIo, modelsComeBack)
{
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const SurfaceModel model = test::randomModel(seed, 12);
    const SurfaceModel read = fromObj(toObj(model));
    ASSERT_EQ(read.patches.size(), model.patches.size());
    for (std::size_t i = 0; i < model.patches.size(); ++i) {
      const TrimmedSurface& before = model.patches[i].geometry;
      const TrimmedSurface& after = read.patches[i].geometry;
      EXPECT_EQ(read.patches[i].label, model.patches[i].label);
      EXPECT_EQ(after.surface().knotsU(), before.surface().knotsU());
      EXPECT_EQ(after.surface().knotsV(), before.surface().knotsV());
      const auto& points = before.surface().homogeneousPoints();
      EXPECT_LE((after.surface().homogeneousPoints() - points).cwiseAbs().maxCoeff(),
                i % 2 == 1 ? 1e-15 * points.cwiseAbs().maxCoeff() : 0.0);
      ASSERT_EQ(after.loops().size(), before.loops().size());
      if (!before.loops().empty())
        test::expectIdentical(after.loops()[0], before.loops()[0]);
      for (std::size_t k = 0; k < before.loops().size(); ++k)
        EXPECT_NEAR(
            after.loops()[k].signedArea(), before.loops()[k].signedArea(), 1e-14);
    }
  }
}

TEST(ObjIo, loopsSayWhetherTheyAreHoles)
{
  SurfacePatch patch;
  const TrimLoop outer = TrimLoop::polygon({{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}});
  const TrimLoop hole =
      TrimLoop::polygon({{0.4, 0.2}, {0.5, 0.4}, {0.6, 0.2}}); // clockwise
  patch.geometry = TrimmedSurface(NurbsSurface(), {outer, hole});
  SurfaceModel model;
  model.patches = {patch};
  const std::string text = toObj(model);
  EXPECT_NE(text.find("trim 0 3 1\nhole 0 3 2\nend"), std::string::npos) << text;
}

TEST(ObjIo, meshesAreSkipped)
{
  EXPECT_TRUE(
      fromObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n").patches.empty());
  EXPECT_TRUE(fromObj("").patches.empty());
}

TEST(ObjIo, errorsNameTheLine)
{
  EXPECT_EQ(problemOf("v 1 0 0 1", "v 1 zero 0 1"),
            "line 2: \"zero\" is not a finite number");
  EXPECT_EQ(problemOf("v 1 0 0 1", "v 1"), "line 2: a point needs 3 coordinates");
  EXPECT_EQ(problemOf(" 4 5 6", " 4 5 7"),
            "line 21: number 7 is not among the 6 given before");
  EXPECT_EQ(problemOf(" 4 5 6", " 4 5"),
            "line 25: a surface has 5 points, its knots need 6");
  EXPECT_EQ(problemOf("cstype bspline", "cstype bezier").rfind("line 14: ", 0), 0U);
  EXPECT_EQ(problemOf("surf 0 1", "surf 0 0.5").rfind("line 25: a part", 0), 0U);
  EXPECT_EQ(problemOf("hole 0 4 1", "hole 0 3 1").rfind("line 25: a part", 0), 0U);
  EXPECT_EQ(problemOf("hole 0 4 1", "hole 0 4").rfind("line 24: ", 0), 0U);
  EXPECT_EQ(problemOf("parm u 0 0 0 1 1 1", "parm w 0 0 0 1 1 1").rfind("line 22", 0),
            0U);
  EXPECT_EQ(problemOf("parm u 0 0 0 1 1 1", "parm u 0 0 0 1 1 -1").rfind("line 25", 0),
            0U);
  EXPECT_EQ(problemOf("\nend\nf", "\nf").rfind("line 25", 0), 0U);
  EXPECT_EQ(problemOf("v 1 0 0 1", "v 1 0 0 -1").rfind("line 25: ", 0), 0U);
}

TEST(ObjIo, brokenTextIsRefusedOrReadNeverWorse)
{
  const std::string good = toObj(test::randomModel(2, 3));
  for (std::size_t size = 0; size < good.size(); size += 5)
    try {
      static_cast<void>(fromObj(good.substr(0, size)));
    } catch (const ObjIoError&) {
    }
  EXPECT_THROW(static_cast<void>(fromObj(good.substr(0, good.size() - 4))), ObjIoError);
}

TEST(ObjIo, filesAreNamedInErrors)
{
  const test::TemporaryFile file("_model.obj");
  EXPECT_THROW(readObjFile(file.path()), ObjIoError);
  writeObjFile(file.path(), test::randomModel(8, 2));
  EXPECT_EQ(readObjFile(file.path()).patches.size(), 2U);
}

} // namespace
