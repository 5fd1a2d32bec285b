// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Weights by distance, normals, intensity, colour and what a user's own points hold.

#define PCL_NO_PRECOMPILE // for a point type of our own
#include "superpixel_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

struct MyPoint {
  PCL_ADD_POINT4D;
  float heat;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
} EIGEN_ALIGN16;

POINT_CLOUD_REGISTER_POINT_STRUCT(
    MyPoint, (float, x, x)(float, y, y)(float, z, z)(float, heat, heat))

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** Segments with points of both halves. */
template <typename PointT>
std::size_t
segmentsOverTheMiddle(GridSegmentation<PointT>& segmentation,
                      const PointCloud<PointT>& cloud)
{
  std::size_t crossing = 0;
  for (const PointIndices& segment : segmentsOf(segmentation, cloud)) {
    const auto left =
        std::count_if(segment.indices.begin(), segment.indices.end(), [&](index_t i) {
          return static_cast<std::uint32_t>(i) % cloud.width < 80;
        });
    const auto all = static_cast<std::ptrdiff_t>(segment.indices.size());
    crossing += left > 0 && left < all ? 1 : 0;
  }
  return crossing;
}

TEST(Weights, distanceAloneIsTheDefault)
{
  const PointCloud<PointXYZ> cloud = boxBeforeWall(4);
  auto segmentation = superpixels<PointXYZ>(50);
  const auto segments = segmentsOf(segmentation, cloud);
  const std::vector<std::uint32_t> labels = segmentation.getLabels();
  segmentation.setWeightFunction(
      [](const PointXYZ& p, const PointXYZ& q, float, float variance) {
        const float distance = (p.getVector3fMap() - q.getVector3fMap()).squaredNorm();
        return std::exp(-0.5F * distance / variance);
      });
  segmentsOf(segmentation, cloud);
  EXPECT_EQ(segmentation.getLabels(), labels);
  segmentation.setWeightFunction(
      [](const PointXYZ& p, const PointXYZ&, float, float) { return p.x + 3.0F; });
  segmentsOf(segmentation, cloud);
  EXPECT_NE(segmentation.getLabels(), labels);
  segmentation.resetWeightFunction();
  segmentsOf(segmentation, cloud);
  EXPECT_EQ(segmentation.getLabels(), labels);
}

TEST(Weights, normalsSeparate)
{
  const auto cloud = paintedWall<PointNormal>([](PointNormal& point, bool left) {
    point.normal_x = left ? 0.6F : 0.0F;
    point.normal_y = 0.0F;
    point.normal_z = left ? 0.8F : -1.0F;
  });
  auto segmentation = superpixels<PointNormal>(23);
  EXPECT_GT(segmentsOverTheMiddle(segmentation, cloud), 0U);
  segmentation.setWeightFunction(NormalWeight());
  EXPECT_EQ(segmentsOverTheMiddle(segmentation, cloud), 0U);
}

TEST(Weights, normalsThatAreMissingOrFlippedDoNot)
{
  const NormalWeight weight{0.2F};
  PointNormal p;
  PointNormal q;
  p.getNormalVector3fMap() = Eigen::Vector3f::UnitZ();
  q.getNormalVector3fMap() = -Eigen::Vector3f::UnitZ();
  EXPECT_FLOAT_EQ(weight(p, q, 0.5F, 1.0F), std::exp(-0.25F));
  q.normal_x = std::nanf("");
  EXPECT_FLOAT_EQ(weight(p, q, 0.5F, 1.0F), std::exp(-0.25F));
  q.getNormalVector3fMap() << 0.6F, 0.0F, 0.8F;
  const float angle = std::acos(0.8F);
  EXPECT_NEAR(weight(p, q, 0.0F, 1.0F), std::exp(-0.5F * angle * angle / 0.04F), 1e-5);
}

TEST(Weights, intensitySeparates)
{
  const auto cloud = paintedWall<PointXYZI>(
      [](PointXYZI& point, bool left) { point.intensity = left ? 40.0F : 90.0F; });
  auto segmentation = superpixels<PointXYZI>(23);
  segmentation.setWeightFunction(IntensityWeight());
  EXPECT_EQ(segmentsOverTheMiddle(segmentation, cloud), 0U);
  segmentation.setWeightFunction(IntensityWeight{1e6F});
  EXPECT_GT(segmentsOverTheMiddle(segmentation, cloud), 0U);
}

TEST(Weights, colourSeparates)
{
  const auto cloud = paintedWall<PointXYZRGB>([](PointXYZRGB& point, bool left) {
    point.r = left ? 200 : 10;
    point.g = 100;
    point.b = left ? 10 : 200;
  });
  auto segmentation = superpixels<PointXYZRGB>(23);
  segmentation.setWeightFunction(ColorWeight());
  EXPECT_EQ(segmentsOverTheMiddle(segmentation, cloud), 0U);
  // 0..255 are bytes: their difference must not wrap around.
  const ColorWeight weight{1.0F};
  EXPECT_EQ(weight(cloud[0], cloud[159], 0.0F, 1.0F),
            weight(cloud[159], cloud[0], 0.0F, 1.0F));
}

TEST(Weights, anyPointTypeWorks)
{
  const auto cloud = paintedWall<MyPoint>(
      [](MyPoint& point, bool left) { point.heat = left ? 0.0F : 1.0F; });
  auto segmentation = superpixels<MyPoint>(23);
  segmentation.setWeightFunction([](const MyPoint& p, const MyPoint& q, float, float) {
    return p.heat == q.heat ? 1.0F : 0.0F;
  });
  EXPECT_EQ(segmentsOverTheMiddle(segmentation, cloud), 0U);
  EXPECT_EQ(segmentation.getNumSegments(), 23U);
}

} // namespace
