// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Clouds, options and weights without sense: a message and no segments. Odd but valid
// ones: segments.

#include "superpixel_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Cloud = PointCloud<PointXYZ>;
using Segmentation = EntropyRateSegmentation<PointXYZ>;

void
expectNothing(Segmentation& segmentation, const Cloud& cloud)
{
  EXPECT_TRUE(segmentsOf(segmentation, cloud).empty());
  EXPECT_TRUE(segmentation.getLabels().empty());
  EXPECT_TRUE(segmentation.getAdjacency().empty());
  EXPECT_TRUE(segmentation.getColoredCloud()->empty());
  EXPECT_EQ(segmentation.getNumSegments(), 0U);
}

TEST(BadInput, givesNoSegments)
{
  const float nan = std::nanf("");
  auto segmentation = superpixels<PointXYZ>(10);
  segmentation.setMinSegmentSize(2);
  std::vector<PointIndices> segments(3);
  segmentation.segment(segments); // no cloud at all
  EXPECT_TRUE(segments.empty());
  expectNothing(segmentation, Cloud());
  expectNothing(segmentation, Cloud(40, 30, PointXYZ(nan, nan, nan)));
  expectNothing(segmentation, Cloud(1, 1, PointXYZ(1.0F, 1.0F, 1.0F)));
  expectNothing(segmentation, Cloud(1200, 1, PointXYZ(1.0F, 1.0F, 1.0F)));
  // Isolated points have no neighbours.
  Cloud isolated = boxBeforeWall(7);
  for (std::size_t i = 0; i < isolated.size(); ++i)
    if (i % 160 % 2 != 0 || i / 160 % 2 != 0)
      isolated[i].x = nan;
  expectNothing(segmentation, isolated);
  segmentation.setMinSegmentSize(1);
  EXPECT_EQ(segmentsOf(segmentation, isolated).size(), 80U * 60U);
}

TEST(BadInput, optionsWithoutSenseGiveNoSegments)
{
  const Cloud cloud = boxBeforeWall(8);
  auto segmentation = superpixels<PointXYZ>(10);
  ASSERT_EQ(segmentsOf(segmentation, cloud).size(), 10U);
  segmentation.setConnectivity(6);
  expectNothing(segmentation, cloud);
  segmentation.setConnectivity(4);
  segmentation.setNumberOfSuperpixels(0);
  expectNothing(segmentation, cloud);
  segmentation.setNumberOfSuperpixels(10);
  segmentation.setBalance(-1.0);
  expectNothing(segmentation, cloud);
  segmentation.setBalance(0.5);
  segmentation.setMinWeight(2.0F); // no edge is as good
  expectNothing(segmentation, cloud);
  segmentation.setMinWeight(1e-4F);
  EXPECT_EQ(segmentsOf(segmentation, cloud).size(), 10U);
}

TEST(BadInput, weightsWithoutSenseGiveNoSegments)
{
  const Cloud cloud = boxBeforeWall(9);
  for (const float bad :
       {std::nanf(""), std::numeric_limits<float>::infinity(), -1.0F, 0.0F})
    for (const bool everywhere : {true, false}) {
      auto segmentation = superpixels<PointXYZ>(10);
      segmentation.setWeightFunction(
          [&](const PointXYZ& p, const PointXYZ&, float, float) {
            return everywhere || p.x > 0.5F ? bad : 1.0F;
          });
      if (bad == 0.0F && !everywhere)
        EXPECT_GE(segmentsOf(segmentation, cloud).size(), 10U);
      else
        expectNothing(segmentation, cloud);
    }
}

TEST(OddInput, twoPointsConstantDepthAndOneSegment)
{
  const float nan = std::nanf("");
  auto segmentation = superpixels<PointXYZ>(1);
  segmentation.setMinSegmentSize(1);
  Cloud two(2, 2, PointXYZ(nan, nan, nan));
  two[0] = PointXYZ(0.0F, 0.0F, 1.0F);
  two[1] = PointXYZ(0.01F, 0.0F, 1.0F);
  EXPECT_LE(segmentsOf(segmentation, two).size(), 2U);
  const Cloud flat = cameraCloud(kSceneCamera, [](int, int) { return 1.0; });
  const auto whole = segmentsOf(segmentation, flat);
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole[0].indices.size(), flat.size());
  EXPECT_TRUE(segmentation.getAdjacency().empty());
  segmentation.setNumberOfSuperpixels(1000000);
  EXPECT_EQ(segmentsOf(segmentation, flat).size(), flat.size());
  // All points in one place.
  segmentation.setNumberOfSuperpixels(5);
  EXPECT_EQ(segmentsOf(segmentation, Cloud(40, 30, PointXYZ(1.0F, 1.0F, 1.0F))).size(),
            5U);
}

} // namespace
