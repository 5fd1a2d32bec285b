// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The class: superpixels of scenes whose surfaces are known, weights by normals,
// intensity, colour and one's own, what it says about neighbours, and bad input.

#define PCL_NO_PRECOMPILE // for a point type of our own
#include <pcl/segmentation/entropy_rate_segmentation.h>
#include <pcl/segmentation/segment_unorganized.h>

#include "grid_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

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
using Cloud = PointCloud<PointXYZ>;
using Segmentation = EntropyRateSegmentation<PointXYZ>;

const GridGeometry kCamera =
    GridGeometry::pinhole(160, 120, {130.0, 130.0, 79.5, 59.5});

template <typename PointT>
EntropyRateSegmentation<PointT>
superpixels(std::size_t number)
{
  EntropyRateSegmentation<PointT> segmentation;
  segmentation.setMode(EntropyRateSegmentation<PointT>::SUPERPIXELS);
  segmentation.setNumberOfSuperpixels(number);
  segmentation.setSensorNoise(SensorNoise::kinect());
  return segmentation;
}

template <typename PointT>
std::vector<PointIndices>
segmentsOf(GridSegmentation<PointT>& segmentation, const PointCloud<PointT>& cloud)
{
  segmentation.setInputCloud(cloud.makeShared());
  std::vector<PointIndices> segments;
  segmentation.segment(segments);
  return segments;
}

/** A wall with a box before it. */
Cloud
boxBeforeWall(unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return cameraCloud(kCamera, [&](int column, int row) {
    const bool box = column >= 50 && column < 110 && row >= 30 && row < 90;
    const double depth = box ? 1.5 : 2.0;
    return depth + 0.3 * SensorNoise::kinect().sigma(depth) * normal(random);
  });
}

/** A flat wall, with what \a paint does to the points of its left half. */
template <typename PointT, typename Paint>
PointCloud<PointT>
paintedWall(const Paint& paint)
{
  const Cloud plain = cameraCloud(kCamera, [](int, int) { return 2.0; });
  PointCloud<PointT> cloud(plain.width, plain.height);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    cloud[i].getVector3fMap() = plain[i].getVector3fMap();
    paint(cloud[i], i % plain.width < 80);
  }
  return cloud;
}

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

TEST(Weights, distanceAloneIsTheDefault)
{
  const Cloud cloud = boxBeforeWall(4);
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
  const Cloud flat = cameraCloud(kCamera, [](int, int) { return 1.0; });
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

TEST(OddInput, tenMillionPoints)
{
  const GridGeometry grid =
      GridGeometry::pinhole(4000, 2500, {3000.0, 3000.0, 1999.5, 1249.5});
  const auto cloud = cameraCloud(grid, [](int column, int row) {
    return 2.0 + 0.2 * ((column / 500 + row / 500) % 2) + 1e-5 * (column * 7 % 11);
  });
  auto segmentation = superpixels<PointXYZ>(2000);
  segmentation.setGeometry(grid);
  segmentation.setConnectivity(4);
  EXPECT_EQ(segmentsOf(segmentation, cloud).size(), 2000U);
}

} // namespace
