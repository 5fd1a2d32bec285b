// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// A point type of the user's own, that the library knows nothing of: templates come
// from the .hpp files, as with PCL's classes.

#define PCL_NO_PRECOMPILE
#include <pcl/pcl_macros.h>
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

#include <pcl/segmentation/entropy_rate_segmentation.h>
#include <pcl/segmentation/segment_unorganized.h>

#include <gtest/gtest.h>

#include <cmath>

namespace user {

/** Position and the temperature of a thermal camera. */
struct EIGEN_ALIGN16 ThermalPoint {
  PCL_ADD_POINT4D;
  float kelvin;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

} // namespace user

POINT_CLOUD_REGISTER_POINT_STRUCT(
    user::ThermalPoint, (float, x, x)(float, y, y)(float, z, z)(float, kelvin, kelvin))

namespace {

using namespace pcl;
using user::ThermalPoint;
using Segmentation = EntropyRateSegmentation<ThermalPoint>;

/** A flat wall with a hot left half, or with a step there. */
PointCloud<ThermalPoint>::Ptr
wall(double step)
{
  auto cloud = pcl::make_shared<PointCloud<ThermalPoint>>(160, 120);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const auto column = static_cast<double>(i % 160);
    const double z = 2.0 + (column < 80.0 ? step : 0.0);
    ThermalPoint& point = (*cloud)[i];
    point.x = static_cast<float>((column - 79.5) / 130.0 * z);
    point.y = static_cast<float>((static_cast<double>(i / 160) - 59.5) / 130.0 * z);
    point.z = static_cast<float>(z);
    point.kelvin = column < 80.0 ? 310.0F : 290.0F;
  }
  return cloud;
}

/** Every segment lies on one side, and both sides are covered. */
void
expectHalves(const std::vector<PointIndices>& segments)
{
  std::size_t points = 0;
  for (const PointIndices& segment : segments) {
    const bool left = segment.indices.front() % 160 < 80;
    for (const index_t index : segment.indices)
      EXPECT_EQ(index % 160 < 80, left);
    points += segment.indices.size();
  }
  EXPECT_EQ(points, 160U * 120U);
}

TEST(UserPointType, surfacesEndAtAStep)
{
  Segmentation segmentation;
  segmentation.setInputCloud(wall(0.3));
  std::vector<PointIndices> segments;
  segmentation.segment(segments);
  EXPECT_EQ(segments.size(), 2U);
  expectHalves(segments);
  EXPECT_EQ(segmentation.getLabelCloud()->size(), 160U * 120U);
}

TEST(UserPointType, superpixelsByAFieldOfItsOwn)
{
  Segmentation segmentation;
  segmentation.setMode(Segmentation::SUPERPIXELS);
  segmentation.setNumberOfSuperpixels(12);
  segmentation.setWeightFunction(
      [](const ThermalPoint& p, const ThermalPoint& q, float distance, float variance) {
        const float warmer = p.kelvin - q.kelvin;
        return std::exp(-0.5F * (distance / variance + warmer * warmer / 4.0F));
      });
  segmentation.setInputCloud(wall(0.0));
  std::vector<PointIndices> segments;
  segmentation.segment(segments);
  EXPECT_EQ(segments.size(), 12U);
  expectHalves(segments);
}

TEST(UserPointType, unorganizedCloudsAreLaidOut)
{
  auto cloud = wall(0.3);
  cloud->height = 1;
  cloud->width = static_cast<std::uint32_t>(cloud->size());
  Segmentation segmentation;
  std::vector<PointIndices> segments;
  EXPECT_TRUE(segmentUnorganized<ThermalPoint>(cloud, segmentation, segments));
  EXPECT_GE(segments.size(), 2U);
}

} // namespace
