// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/surface_render.h>
#include <pcl/surface/nurbs/tessellation.h>

#include "closed_surfaces.h"

#include <gtest/gtest.h>

#include <png.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

namespace {

using namespace pcl::nurbs;

SurfaceModel
modelOf(const std::vector<NurbsSurface>& surfaces)
{
  SurfaceModel model;
  for (const NurbsSurface& surface : surfaces) {
    model.patches.emplace_back();
    model.patches.back().geometry = TrimmedSurface(surface);
  }
  return model;
}

NurbsSurface
squareAt(double z, double half)
{
  Eigen::Matrix3Xd points(3, 4);
  points << -half, -half, half, half, -half, half, -half, half, z, z, z, z;
  return NurbsSurface::fromControlPoints(
      KnotVector::bezier(1), KnotVector::bezier(1), points);
}

RenderOptions
fromSensor()
{
  RenderOptions options;
  options.width = 320;
  options.height = 240;
  options.camera = Camera::sensor(M_PI / 2.0);
  options.borders = false;
  return options;
}

int
countForeground(const Image& image, const Rgb& background)
{
  return static_cast<int>(
      std::count_if(image.pixels.begin(), image.pixels.end(), [&](const Rgb& pixel) {
        return pixel != background;
      }));
}

Image
readPng(const std::string& path)
{
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  Image image;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0)
    return image;
  png.format = PNG_FORMAT_RGB;
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  image.pixels.resize(png.width * png.height);
  png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr);
  return image;
}

TEST(Render, sphereSilhouetteHasTheRightArea)
{
  const RenderOptions options = fromSensor();
  const Eigen::Affine3d away(Eigen::Translation3d(0.0, 0.0, 5.0));
  const Image image =
      renderModel(modelOf({test::sphere(1.0).transformed(away)}), options);
  // The cone of sight has the half angle asin(1 / 5).
  const double radius = 120.0 * std::tan(std::asin(0.2));
  const double area = M_PI * radius * radius;
  EXPECT_NEAR(countForeground(image, options.background), area, 0.04 * area + 40.0);
  // Lit from the front: the middle is brighter than the rim.
  EXPECT_GT(image.at(160, 120)[0],
            image.at(160 - static_cast<int>(radius) + 2, 120)[0]);
  EXPECT_EQ(image.at(2, 2), options.background);
}

TEST(Render, sensorViewLooksAlongZWithYDown)
{
  const RenderOptions options = fromSensor();
  // A square at x > 0, y > 0 appears right of and below the middle.
  const Eigen::Affine3d shift(Eigen::Translation3d(1.0, 0.5, 0.0));
  const Image image =
      renderModel(modelOf({squareAt(2.0, 0.2).transformed(shift)}), options);
  EXPECT_NE(image.at(160 + 60, 120 + 30), options.background);
  EXPECT_EQ(image.at(160 - 60, 120 + 30), options.background);
  EXPECT_EQ(image.at(160 + 60, 120 - 30), options.background);
  EXPECT_NEAR(countForeground(image, options.background), 24.0 * 24.0, 60.0);
}

TEST(Render, nearerSurfacesHideFartherOnes)
{
  const RenderOptions options = fromSensor();
  for (const bool near_first : {true, false}) {
    const NurbsSurface near = squareAt(1.0, 0.2);
    const NurbsSurface far = squareAt(2.0, 1.0);
    const SurfaceModel model = near_first ? modelOf({near, far}) : modelOf({far, near});
    RenderOptions by_scalar = options;
    by_scalar.colouring = Colouring::Scalar;
    by_scalar.range = {{0.0, 1.0}};
    const TriangleMesh mesh = tessellate(model);
    std::vector<double> scalars;
    for (const Eigen::Vector3d& p : mesh.vertices)
      scalars.push_back(p.z() < 1.5 ? 0.0 : 1.0);
    const Image image = renderMesh(mesh, by_scalar, scalars);
    const Rgb middle = image.at(160, 120);
    const Rgb side = image.at(160 + 40, 120);
    EXPECT_GT(middle[2], middle[0]) << "blue is near";
    EXPECT_GT(side[0], side[2]) << "red is far";
  }
}

TEST(Render, surfacesBehindTheCameraAreClipped)
{
  const RenderOptions options = fromSensor();
  EXPECT_EQ(countForeground(renderModel(modelOf({squareAt(-1.0, 0.5)}), options),
                            options.background),
            0);
  // A floor from behind the camera to far ahead fills the picture below the horizon.
  Eigen::Matrix3Xd points(3, 4);
  points << -500, -500, 500, 500, 1, 1, 1, 1, -5, 500, -5, 500;
  const Image floor =
      renderModel(modelOf({NurbsSurface::fromControlPoints(
                      KnotVector::bezier(1), KnotVector::bezier(1), points)}),
                  options);
  EXPECT_NEAR(countForeground(floor, options.background), 320 * 120, 320 * 3);
  EXPECT_NE(floor.at(5, 235), options.background);
  EXPECT_EQ(floor.at(160, 60), options.background);
}

TEST(Render, bordersAreDarkAndThin)
{
  RenderOptions options = fromSensor();
  options.borders = true;
  const Image image = renderModel(modelOf({squareAt(2.0, 1.0)}), options);
  int dark = 0;
  for (const Rgb& pixel : image.pixels)
    dark += pixel[0] + pixel[1] + pixel[2] < 270 ? 1 : 0;
  EXPECT_GT(dark, 150);
  EXPECT_LT(dark, 4 * 120 * 2 + 8);
  EXPECT_GT(image.at(160, 120)[2], 120);
}

TEST(Render, pointsAreTestedAgainstTheDepth)
{
  const RenderOptions options = fromSensor();
  const std::vector<Eigen::Vector3f> points = {
      {0.5F, 0.0F, 1.5F},                                    // before
      {-0.5F, 0.0F, 3.0F},                                   // behind
      {0.0F, 0.51F, 2.005F},                                 // within noise
      {0.0F, 0.0F, std::numeric_limits<float>::quiet_NaN()}, // no return
      {0.0F, 0.0F, -1.0F}};
  const std::vector<Rgb> colours(points.size(), Rgb{255, 0, 0});
  const Image image = renderModel(modelOf({squareAt(2.0, 1.5)}),
                                  options,
                                  {points.data(), points.size(), colours.data()});
  const Rgb red = {255, 0, 0};
  EXPECT_EQ(image.at(160 + 40, 120), red);
  EXPECT_EQ(image.at(160, 120 + 30), red);
  EXPECT_EQ(std::count(image.pixels.begin(), image.pixels.end(), red), 2);
}

TEST(Render, chosenCameraSeesEverything)
{
  RenderOptions options;
  options.width = 200;
  options.height = 100;
  const Image image = renderModel(modelOf({test::torus(2.0, 0.5)}), options);
  bool touches_border = false;
  int lowest = image.width, highest = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.at(x, y) != options.background) {
        touches_border |=
            x == 0 || y == 0 || x == image.width - 1 || y == image.height - 1;
        lowest = std::min(lowest, y);
        highest = std::max(highest, y);
      }
  EXPECT_FALSE(touches_border);
  EXPECT_GT(highest - lowest, image.height / 2) << "fills the picture";
}

TEST(Render, curvatureOfASphereIsUniform)
{
  RenderOptions options = fromSensor();
  options.colouring = Colouring::Curvature;
  options.range = {{-2.0, 2.0}};
  const Eigen::Affine3d away(Eigen::Translation3d(0.0, 0.0, 3.0));
  // Normals point outwards, so the sphere bends away from them: negative, blue.
  const Image image =
      renderModel(modelOf({test::sphere(0.5).transformed(away)}), options);
  const Rgb middle = image.at(160, 120);
  EXPECT_GT(middle[2], middle[0] + 60);
  options.range = {{-1e3, 1e3}};
  const Rgb pale =
      renderModel(modelOf({test::sphere(0.5).transformed(away)}), options).at(160, 120);
  EXPECT_NEAR(pale[2], pale[0], 3);
}

TEST(Render, pngReadsBack)
{
  const std::string path = testing::TempDir() + "render_test.png";
  RenderOptions options = fromSensor();
  options.colouring = Colouring::Normal;
  const Image image = renderModel(modelOf({squareAt(2.0, 1.0)}), options);
  writePng(path, image);
  const Image back = readPng(path);
  EXPECT_EQ(back.width, image.width);
  EXPECT_EQ(back.height, image.height);
  EXPECT_EQ(back.pixels, image.pixels);
  std::filesystem::remove(path);
}

TEST(Render, emptyModelIsAnEmptyPicture)
{
  const RenderOptions options;
  const Image image = renderModel(SurfaceModel(), options);
  EXPECT_EQ(image.pixels.size(), 480000U);
  EXPECT_EQ(countForeground(image, options.background), 0);
}

TEST(Render, rejectsBadInput)
{
  const SurfaceModel model = modelOf({squareAt(1.0, 1.0)});
  RenderOptions options;
  options.width = 0;
  EXPECT_THROW(renderModel(model, options), std::invalid_argument);
  options = {};
  options.colouring = Colouring::Scalar;
  EXPECT_THROW(renderModel(model, options), std::invalid_argument);
  options = {};
  options.camera = Camera();
  options.camera->up = Eigen::Vector3d::UnitZ();
  EXPECT_THROW(renderModel(model, options), std::invalid_argument);
  options.camera = Camera::sensor(0.0);
  EXPECT_THROW(renderModel(model, options), std::invalid_argument);
  EXPECT_THROW(writePng("/tmp/x.png", Image()), std::invalid_argument);
  const Image image = renderModel(model, RenderOptions());
  try {
    writePng("/no/such/folder/x.png", image);
    FAIL() << "the folder is not there";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "cannot write /no/such/folder/x.png: No such file or directory");
  }
}

} // namespace
