// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The PCL class: stages can be replaced, bad input gives false and a message.

#include <pcl/mapping/demo_scene.h>
#include <pcl/mapping/nurbs_reconstruction.h>

#include "reconstruction_checks.h"

#include <pcl/common/io.h>

#include <limits>
#include <numeric>
#include <random>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Cloud = PointCloud<PointXYZ>;
using Reconstructor = NurbsReconstruction<PointXYZ>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Cloud::Ptr
scattered(const std::vector<Eigen::Vector3f>& points)
{
  Cloud::Ptr cloud(new Cloud);
  for (const Eigen::Vector3f& point : points)
    cloud->emplace_back(point.x(), point.y(), point.z());
  return cloud;
}

/** It must say no, in words, and leave nothing behind. */
void
expectRefused(Reconstructor& reconstructor)
{
  SurfaceModel model;
  model.patches.resize(1);
  testing::internal::CaptureStderr();
  const bool found = reconstructor.reconstruct(model);
  const std::string message = testing::internal::GetCapturedStderr();
  EXPECT_FALSE(found);
  EXPECT_TRUE(model.patches.empty());
  EXPECT_NE(message.find("[pcl::"), std::string::npos) << message;
}

void
expectRefused(const Cloud::Ptr& cloud)
{
  Reconstructor reconstructor;
  reconstructor.setInputCloud(cloud);
  expectRefused(reconstructor);
}

TEST(NurbsReconstruction, cloudsWithoutSurfacesAreRefused)
{
  expectRefused(Cloud::Ptr());
  expectRefused(scattered({}));
  expectRefused(scattered({{1.0F, 2.0F, 3.0F}}));
  expectRefused(scattered({{1.0F, 2.0F, 3.0F}, {2.0F, 2.0F, 3.0F}}));
  expectRefused(scattered(std::vector<Eigen::Vector3f>(500, {1.0F, 2.0F, 3.0F})));
  expectRefused(scattered(std::vector<Eigen::Vector3f>(500, {0.0F, 0.0F, 0.0F})));
  expectRefused(scattered(std::vector<Eigen::Vector3f>(500, {kNan, kNan, kNan})));
  std::vector<Eigen::Vector3f> line;
  for (int k = 0; k < 2000; ++k)
    line.emplace_back(1.0F + 0.01F * static_cast<float>(k), 2.0F, 3.0F);
  expectRefused(scattered(line));
  Cloud::Ptr organized(new Cloud(30, 20, PointXYZ(kNan, kNan, kNan)));
  expectRefused(organized);
}

/** A line has no area; whatever is made of it, nothing crashes. */
TEST(NurbsReconstruction, degenerateCloudsAreSafe)
{
  std::vector<Eigen::Vector3f> line;
  std::vector<Eigen::Vector3f> twice;
  std::vector<Eigen::Vector3f> huge;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> value(-1.0F, 1.0F);
  for (int k = 0; k < 2000; ++k) {
    line.emplace_back(1.0F + 0.01F * static_cast<float>(k), 2.0F, 3.0F);
    twice.emplace_back(value(random), value(random), 3.0F);
    twice.push_back(twice.back());
    huge.emplace_back(1e30F * value(random), 1e30F * value(random), 1e30F);
  }
  for (const auto& points : {line, twice, huge})
    for (const float scale : {1e-30F, 1e-6F, 1.0F, 1e6F}) {
      std::vector<Eigen::Vector3f> scaled;
      for (const Eigen::Vector3f& point : points)
        scaled.push_back(scale * point);
      Reconstructor reconstructor;
      reconstructor.setInputCloud(scattered(scaled));
      SurfaceModel model;
      testing::internal::CaptureStderr();
      EXPECT_NO_THROW(reconstructor.reconstruct(model));
      const std::string message = testing::internal::GetCapturedStderr();
      EXPECT_TRUE(!model.patches.empty() || !message.empty());
    }
}

TEST(NurbsReconstruction, wrongOptionsAndGeometryAreRefused)
{
  const DemoScene scene({160, 120, 1, true});
  Reconstructor reconstructor;
  reconstructor.setInputCloud(scene.cloud());
  ReconstructionOptions options;
  options.knots.max_degree = 99;
  reconstructor.setOptions(options);
  expectRefused(reconstructor);
  reconstructor.setOptions({});
  reconstructor.setGeometry(GridGeometry::pinhole(10, 10, scene.intrinsics()));
  expectRefused(reconstructor);
}

TEST(NurbsReconstruction, aFailureLeavesNoOldResult)
{
  const DemoScene scene({160, 120, 1, true});
  Reconstructor reconstructor;
  reconstructor.setInputCloud(scene.cloud());
  SurfaceModel model;
  ASSERT_TRUE(reconstructor.reconstruct(model));
  reconstructor.setInputCloud(scattered({}));
  expectRefused(reconstructor);
  EXPECT_TRUE(reconstructor.getReconstruction().model.patches.empty());
  EXPECT_EQ(reconstructor.getNumSegments(), 0U);
}

TEST(NurbsReconstruction, onlyIndexedPointsCount)
{
  const DemoScene scene({160, 120, 1, true});
  const IndicesPtr upper(new Indices(160 * 60));
  std::iota(upper->begin(), upper->end(), 0);
  Reconstructor reconstructor;
  reconstructor.setInputCloud(scene.cloud());
  reconstructor.setIndices(upper);
  SurfaceModel model;
  ASSERT_TRUE(reconstructor.reconstruct(model));
  const std::vector<std::uint32_t>& labels = reconstructor.getReconstruction().labels;
  ASSERT_EQ(labels.size(), scene.cloud()->size());
  for (std::size_t cell = upper->size(); cell < labels.size(); ++cell)
    ASSERT_EQ(labels[cell], 0U);
}

/** Left and right half of the image are one segment each. */
class HalvesSegmentation : public GridSegmentation<PointXYZ> {
protected:
  std::uint32_t
  performSegmentation(const GridPoints& points,
                      GridGraph&,
                      const SensorNoise&,
                      std::vector<std::uint32_t>& labels) override
  {
    const auto width = static_cast<std::size_t>(points.geometry.width);
    labels.resize(points.size());
    for (std::size_t cell = 0; cell < labels.size(); ++cell)
      labels[cell] = !points.valid(cell) ? 0 : cell % width < width / 2 ? 1 : 2;
    return 2;
  }
};

TEST(NurbsReconstruction, stagesCanBeReplaced)
{
  const DemoScene scene({160, 120, 1, true});
  SensorNoise noise;
  noise.constant = 0.05;
  Reconstructor reconstructor;
  reconstructor.setInputCloud(scene.cloud());
  reconstructor.setGeometry(GridGeometry::pinhole(160, 120, scene.intrinsics()));
  reconstructor.setSensorNoise(noise);
  reconstructor.setSegmentation(
      GridSegmentation<PointXYZ>::Ptr(new HalvesSegmentation));
  scene.cloud()->header.frame_id = "camera";
  SurfaceModel model;
  ASSERT_TRUE(reconstructor.reconstruct(model));
  EXPECT_EQ(model.frame_id, "camera");
  EXPECT_EQ(reconstructor.getNumSegments(), 2U);
  EXPECT_EQ(reconstructor.getUsedNoise().constant, 0.05);
  EXPECT_EQ(reconstructor.getGeometry().intrinsics().fx, scene.intrinsics().fx);
  for (const SurfacePatch& patch : model.patches) {
    EXPECT_TRUE(patch.label == 1 || patch.label == 2);
    EXPECT_NEAR(patch.quality.noise, 0.05, 1e-12);
  }
}

TEST(NurbsReconstruction, everyPointTypeGivesTheSame)
{
  const DemoScene scene({160, 120, 1, true});
  Reconstructor plain;
  plain.setInputCloud(scene.cloud());
  SurfaceModel model;
  ASSERT_TRUE(plain.reconstruct(model));
  const PointCloud<PointXYZRGBNormal>::Ptr rich(new PointCloud<PointXYZRGBNormal>);
  copyPointCloud(*scene.cloud(), *rich);
  NurbsReconstruction<PointXYZRGBNormal> other;
  other.setInputCloud(rich);
  ASSERT_TRUE(other.reconstruct(model));
  expectIdentical(plain.getReconstruction(), other.getReconstruction());
}

} // namespace
