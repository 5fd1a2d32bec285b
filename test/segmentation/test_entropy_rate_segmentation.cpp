// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The class: superpixels of scenes whose surfaces are known, and what it says about
// neighbours.

#include "superpixel_scenes.h"

#include <pcl/segmentation/segment_unorganized.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Cloud = PointCloud<PointXYZ>;

TEST(Superpixels, asManyAsAskedForAndNoneOverAJump)
{
  const Cloud cloud = boxBeforeWall(1);
  for (const int connectivity : {4, 8}) {
    auto segmentation = superpixels<PointXYZ>(60);
    segmentation.setConnectivity(connectivity);
    const auto segments = segmentsOf(segmentation, cloud);
    EXPECT_EQ(segments.size(), 60U);
    std::size_t points = 0;
    for (const PointIndices& segment : segments) {
      points += segment.indices.size();
      const bool near = cloud[static_cast<std::size_t>(segment.indices[0])].z < 1.75F;
      for (const index_t i : segment.indices)
        ASSERT_EQ(cloud[static_cast<std::size_t>(i)].z < 1.75F, near);
    }
    EXPECT_EQ(points, cloud.size());
  }
}

TEST(Superpixels, adjacencyIsThatOfTheLabels)
{
  auto segmentation = superpixels<PointXYZ>(40);
  EXPECT_TRUE(segmentation.getAdjacency().empty());
  const Cloud cloud = paintedWall<PointXYZ>([](PointXYZ&, bool) {});
  ASSERT_EQ(segmentsOf(segmentation, cloud).size(), 40U);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> expected;
  const auto& labels = segmentation.getLabels();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (i % 160 != 159 && labels[i] != labels[i + 1])
      ++expected[std::minmax(labels[i], labels[i + 1])];
    if (i + 160 < labels.size() && labels[i] != labels[i + 160])
      ++expected[std::minmax(labels[i], labels[i + 160])];
  }
  const auto borders = segmentation.getAdjacency();
  ASSERT_EQ(borders.size(), expected.size());
  auto next = expected.begin();
  for (const SegmentBorder& border : borders) {
    EXPECT_EQ(std::pair(border.first, border.second), next->first);
    EXPECT_EQ(border.cells, next->second);
    // Pixels of a wall that faces the camera are squares of 2 m / 130.
    EXPECT_NEAR(border.length, static_cast<double>(border.cells) * 2.0 / 130.0, 1e-4);
    ++next;
  }
}

TEST(Superpixels, nothingTouchesOverAJump)
{
  const Cloud cloud = boxBeforeWall(2);
  auto segmentation = superpixels<PointXYZ>(30);
  const auto segments = segmentsOf(segmentation, cloud);
  ASSERT_EQ(segments.size(), 30U);
  EXPECT_GT(segmentation.getAdjacency().size(), 30U);
  const auto isNear = [&](std::uint32_t label) {
    return cloud[static_cast<std::size_t>(segments[label - 1].indices[0])].z < 1.75F;
  };
  for (const SegmentBorder& border : segmentation.getAdjacency())
    EXPECT_EQ(isNear(border.first), isNear(border.second));
}

TEST(Superpixels, indicesAreRespected)
{
  const Cloud cloud = boxBeforeWall(3);
  auto indices = pcl::make_shared<Indices>();
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (i % 160 < 100 && i / 160 > 20)
      indices->push_back(static_cast<index_t>(i));
  auto segmentation = superpixels<PointXYZ>(20);
  segmentation.setIndices(indices);
  const auto segments = segmentsOf(segmentation, cloud);
  EXPECT_EQ(segments.size(), 20U);
  std::set<index_t> found;
  for (const PointIndices& segment : segments)
    found.insert(segment.indices.begin(), segment.indices.end());
  EXPECT_EQ(found, std::set<index_t>(indices->begin(), indices->end()));
}

TEST(Superpixels, goOnOverTheSeamOfALaser)
{
  const GridGeometry grid = turningLaser(360, 16);
  const Cloud cloud = laserCloud(grid, [](int, int) { return 5.0; });
  for (const bool wrap : {true, false}) {
    GridGeometry geometry = grid;
    geometry.wrap = wrap;
    auto segmentation = superpixels<PointXYZ>(1);
    segmentation.setGeometry(geometry);
    // A tower that is cut in half where it faces away from the seam.
    Cloud halves = cloud;
    for (std::uint32_t row = 0; row < 16; ++row)
      halves(180, row).x = std::nanf("");
    EXPECT_EQ(segmentsOf(segmentation, halves).size(), wrap ? 1U : 2U);
  }
}

TEST(Threads, anyNumberGivesTheSame)
{
  const Cloud cloud = boxBeforeWall(5);
  std::vector<std::uint32_t> one;
  for (const unsigned int threads : {1U, 2U, 4U}) {
    auto segmentation = superpixels<PointXYZ>(50);
    segmentation.setNumberOfThreads(threads);
    segmentsOf(segmentation, cloud);
    if (threads == 1)
      one = segmentation.getLabels();
    EXPECT_EQ(segmentation.getLabels(), one);
    EXPECT_FALSE(one.empty());
  }
}

TEST(Unorganized, segmentsHoldIndicesOfTheCloud)
{
  Cloud cloud = boxBeforeWall(6);
  std::shuffle(cloud.begin(), cloud.end(), std::mt19937(1));
  cloud.width = static_cast<std::uint32_t>(cloud.size());
  cloud.height = 1;
  auto segmentation = superpixels<PointXYZ>(50);
  std::vector<PointIndices> segments;
  EXPECT_TRUE(segmentsOf(segmentation, cloud).empty());
  ASSERT_TRUE(segmentUnorganized<PointXYZ>(cloud.makeShared(), segmentation, segments));
  std::set<index_t> seen;
  std::size_t mixed = 0;
  for (const PointIndices& segment : segments) {
    std::set<bool> near;
    for (const index_t i : segment.indices) {
      EXPECT_TRUE(seen.insert(i).second);
      near.insert(cloud[static_cast<std::size_t>(i)].z < 1.75F);
    }
    mixed += near.size() > 1 ? 1 : 0;
  }
  EXPECT_EQ(segments.size(), segmentation.getNumSegments());
  EXPECT_GT(seen.size(), 0.9 * static_cast<double>(cloud.size()));
  EXPECT_EQ(mixed, 0U);
  EXPECT_FALSE(segmentUnorganized<PointXYZ>(nullptr, segmentation, segments));
  EXPECT_TRUE(segments.empty());
  EXPECT_FALSE(
      segmentUnorganized<PointXYZ>(Cloud().makeShared(), segmentation, segments));
}

} // namespace
