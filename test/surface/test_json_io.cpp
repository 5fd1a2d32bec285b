// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/json_io.h>

#include "model_equality.h"
#include "random_models.h"

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;

const char* const kBilinear = R"({"format": "pcl_nurbs", "version": 1, "patches": [
  {"degree_u": 1, "degree_v": 1, "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 2, 2],
   "points": [0,0,0, 0,2,0, 1,0,0, 1,2,0.5]}]})";

/** Message of the error that \a text raises. */
std::string
problemOf(const std::string& text)
{
  try {
    static_cast<void>(fromJson(text));
  } catch (const JsonIoError& error) {
    return error.what();
  }
  return "none";
}

std::string
replaced(std::string text, const std::string& from, const std::string& to)
{
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST(JsonIo, polynomialModelsComeBackBitByBit)
{
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SurfaceModel model = test::randomModel(seed, 12);
    for (std::size_t i = 0; i < model.patches.size(); ++i) // odd ones are rational
      if (i % 2 == 1)
        model.patches[i].geometry = {};
    const SurfaceModel read = fromJson(toJson(model));
    ASSERT_EQ(read.patches.size(), model.patches.size());
    for (std::size_t i = 0; i < model.patches.size(); ++i)
      if (i % 3 != 2) // those have a rational trimming curve
        test::expectIdentical(read.patches[i], model.patches[i]);
    EXPECT_EQ(read.frame_id, model.frame_id);
    EXPECT_EQ(read.metadata, model.metadata);
  }
}

TEST(JsonIo, rationalModelsComeBackToRounding)
{
  const SurfaceModel model = test::randomModel(3, 24);
  const SurfaceModel read = fromJson(toJson(model));
  ASSERT_EQ(read.patches.size(), model.patches.size());
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    const auto& before = model.patches[i].geometry;
    const auto& after = read.patches[i].geometry;
    const auto& points = before.surface().homogeneousPoints();
    EXPECT_LE((after.surface().homogeneousPoints() - points).cwiseAbs().maxCoeff(),
              1e-15 * points.cwiseAbs().maxCoeff());
    EXPECT_EQ(after.surface().homogeneousPoints().row(3), points.row(3));
    ASSERT_EQ(after.loops().size(), before.loops().size());
    for (std::size_t k = 0; k < before.loops().size(); ++k)
      EXPECT_NEAR(after.loops()[k].signedArea(), before.loops()[k].signedArea(), 1e-14);
  }
}

TEST(JsonIo, smallHandWrittenFileIsRead)
{
  const SurfaceModel model = fromJson(kBilinear);
  ASSERT_EQ(model.patches.size(), 1U);
  const NurbsSurface& surface = model.patches[0].geometry.surface();
  EXPECT_EQ(surface.evaluate(0.5, 1.0), Eigen::Vector3d(0.5, 1.0, 0.125));
  EXPECT_EQ(model.patches[0].label, 0U);
  const std::string nested = replaced(kBilinear,
                                      "[0,0,0, 0,2,0, 1,0,0, 1,2,0.5]",
                                      "[[[0,0,0], [0,2,0]], [[1,0,0], [1,2,0.5]]]");
  EXPECT_EQ(fromJson(nested).patches[0].geometry.surface().homogeneousPoints(),
            surface.homogeneousPoints());
}

TEST(JsonIo, qualityThatIsNotKnownIsNull)
{
  SurfaceModel model = fromJson(kBilinear);
  model.patches[0].quality.rmse = std::nan("");
  EXPECT_TRUE(std::isnan(fromJson(toJson(model)).patches[0].quality.rmse));
}

TEST(JsonIo, errorsNameThePlace)
{
  const std::string good = kBilinear;
  const auto problem = [&](const std::string& from, const std::string& to) {
    return problemOf(replaced(good, from, to));
  };
  EXPECT_EQ(problem("pcl_nurbs", "obj"), "/format: is not \"pcl_nurbs\"");
  EXPECT_EQ(problem("\"version\": 1", "\"version\": 2"), "/version: is not 1");
  EXPECT_EQ(problem("\"patches\"", "\"patch\""), "/: has no \"patches\"");
  EXPECT_EQ(problem("[0, 0, 1, 1]", "[0, 0, 1, \"1\"]"),
            "/patches/0/knots_u/3: is not a number");
  EXPECT_EQ(problem("[0, 0, 1, 1]", "[0, 2, 1, 1]").rfind("/patches/0/knots_u: ", 0),
            0U);
  EXPECT_EQ(problem("1,2,0.5", "1,2"),
            "/patches/0/points: has 11 numbers, the knots need 12");
  EXPECT_EQ(problem("\"degree_u\": 1", "\"degree_u\": 10"),
            "/patches/0/degree_u: is not an integer from 0 to 9");
  EXPECT_EQ(problem("\"degree_u\": 1", "\"degree_u\": -1"),
            "/patches/0/degree_u: is not an integer from 0 to 9");
  EXPECT_EQ(problem("\"points\"", "\"weights\": [1, 1, 1], \"points\""),
            "/patches/0/weights: has 3 numbers, there are 4 points");
  EXPECT_EQ(problem("\"points\"", "\"weights\": [1, 1, 1, 0], \"points\"")
                .rfind("/patches/0", 0),
            0U);
  EXPECT_EQ(
      problem("\"points\"", "\"label\": -3, \"points\"").rfind("/patches/0/label", 0),
      0U);
  EXPECT_EQ(problem("\"points\"", "\"trims\": [[]], \"points\"")
                .rfind("/patches/0/trims/0: ", 0),
            0U);
}

TEST(JsonIo, brokenTextIsRefused)
{
  const std::string good = toJson(test::randomModel(2, 2));
  for (std::size_t size = 0; size + 3 < good.size(); size += 7)
    EXPECT_THROW(static_cast<void>(fromJson(good.substr(0, size))), JsonIoError);
  EXPECT_NE(problemOf(std::string(100000, '[')).find("nested"), std::string::npos);
  EXPECT_NE(problemOf("{\"format\": 1e999}"), "none");
}

TEST(JsonIo, filesAreNamedInErrors)
{
  const test::TemporaryFile file("_model.json");
  EXPECT_THROW(readJsonFile(file.path()), JsonIoError);
  const SurfaceModel model = test::randomModel(8, 1);
  writeJsonFile(file.path(), model);
  test::expectIdentical(readJsonFile(file.path()), model);
}

} // namespace
