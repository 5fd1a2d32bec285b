// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Connected groups on scenes whose sheets are known: floors at grazing angle stay
// whole, jumps and folds separate, the seam of a laser does not.

#include <pcl/segmentation/grid_segmentation.h>

#include "grid_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
using Cloud = PointCloud<PointXYZ>;
using Segmentation = ConnectedGroupsSegmentation<PointXYZ>;

const GridGeometry kCamera =
    GridGeometry::pinhole(320, 240, {262.5, 262.5, 159.5, 119.5});

std::vector<PointIndices>
segmentsOf(Segmentation& segmentation, const Cloud& cloud)
{
  segmentation.setInputCloud(cloud.makeShared());
  std::vector<PointIndices> segments;
  segmentation.segment(segments);
  return segments;
}

/** Adds the Kinect's noise to a depth. */
class Noisy {
public:
  explicit Noisy(unsigned seed) : random_(seed) {}

  double
  operator()(double depth)
  {
    return depth + SensorNoise::kinect().sigma(depth) * normal_(random_);
  }

private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

/** A floor 0.5 m under the camera, seen from 1.1 m to 8 m. */
double
floorDepth(int row)
{
  const double slope = (row - kCamera.intrinsics().cy) / kCamera.intrinsics().fy;
  return slope > 0.5 / 8.0 ? 0.5 / slope : std::nan("");
}

TEST(ConnectedGroups, exactFloorAtGrazingAngleIsOne)
{
  const Cloud cloud =
      cameraCloud(kCamera, [](int, int row) { return floorDepth(row); });
  Segmentation segmentation;
  segmentation.setSensorNoise({});
  const auto segments = segmentsOf(segmentation, cloud);
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_EQ(segments[0].indices.size(),
            static_cast<std::size_t>(
                std::count_if(cloud.begin(), cloud.end(), [](const PointXYZ& p) {
                  return !std::isnan(p.z);
                })));
}

TEST(ConnectedGroups, noisyFloorIsNearlyOne)
{
  Noisy noisy(1);
  const Cloud cloud = cameraCloud(kCamera, [&](int, int row) {
    const double depth = floorDepth(row);
    return depth < 4.0 ? noisy(depth) : std::nan("");
  });
  Segmentation segmentation;
  segmentation.setSensorNoise(SensorNoise::kinect());
  const auto segments = segmentsOf(segmentation, cloud);
  ASSERT_FALSE(segments.empty());
  const auto valid = std::count_if(
      cloud.begin(), cloud.end(), [](const PointXYZ& p) { return !std::isnan(p.z); });
  EXPECT_GT(segments[0].indices.size(), 0.98 * static_cast<double>(valid));
}

TEST(ConnectedGroups, jumpSeparates)
{
  Noisy noisy(2);
  const Cloud cloud = cameraCloud(kCamera, [&](int column, int row) {
    const bool object = column > 100 && column < 200 && row > 60 && row < 160;
    return noisy(object ? 1.8 : 2.0);
  });
  Segmentation segmentation;
  segmentation.setSensorNoise(SensorNoise::kinect());
  const auto segments = segmentsOf(segmentation, cloud);
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_NEAR(static_cast<double>(segments[1].indices.size()), 99.0 * 99.0, 400.0);
}

/** Two walls that meet in a vertical edge straight ahead. */
double
roofDepth(int column, double half_angle)
{
  const double slope =
      std::abs(column - kCamera.intrinsics().cx) / kCamera.intrinsics().fx;
  return 1.5 / (1.0 - slope / std::tan(half_angle) * -1.0);
}

TEST(ConnectedGroups, foldSeparatesUnlessToldNotTo)
{
  Noisy noisy(3);
  const Cloud cloud = cameraCloud(
      kCamera, [&](int column, int) { return noisy(roofDepth(column, 0.8)); });
  Segmentation segmentation;
  segmentation.setSensorNoise(SensorNoise::kinect());
  const auto segments = segmentsOf(segmentation, cloud);
  ASSERT_EQ(segments.size(), 2U);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const int column = static_cast<int>(i % cloud.width);
    if (std::abs(column - 160) > 3) {
      EXPECT_EQ(segmentation.getLabels()[i],
                segmentation.getLabels()[column < 160 ? 0 : 319]);
    }
  }
  segmentation.setSplitCreases(false);
  EXPECT_EQ(segmentsOf(segmentation, cloud).size(), 1U);
}

TEST(ConnectedGroups, cylinderIsOneSheet)
{
  Noisy noisy(4);
  const double radius = 0.3;
  const Cloud cloud = cameraCloud(kCamera, [&](int column, int) {
    const double u = kCamera.first_u + column * kCamera.step_u;
    // (z u)^2 + (z - 1.2)^2 = r^2
    const double a = 1.0 + u * u;
    const double root = 1.44 - a * (1.44 - radius * radius);
    return root < 0.02 ? std::nan("") : noisy((1.2 - std::sqrt(root)) / a);
  });
  Segmentation segmentation;
  segmentation.setSensorNoise(SensorNoise::kinect());
  EXPECT_EQ(segmentsOf(segmentation, cloud).size(), 1U);
}

TEST(ConnectedGroups, laserRoomIsConnectedOverTheSeam)
{
  const GridGeometry grid = turningLaser(720, 32);
  // A round tower with a slit in front and one at the side, none at the seam behind.
  const Cloud cloud = laserCloud(grid, [](int column, int) {
    return column / 4 == 90 || column / 4 == 40 ? std::nan("") : 5.0;
  });
  Segmentation segmentation;
  segmentation.setSensorNoise(SensorNoise::hdl64());
  const auto segments = segmentsOf(segmentation, cloud);
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segmentation.getLabels()[0], segmentation.getLabels()[719]);
}

TEST(ConnectedGroups, labelsAreOrderedCompleteAndRepeatable)
{
  std::mt19937 random(9);
  Noisy noisy(9);
  const Cloud cloud = cameraCloud(kCamera, [&](int column, int row) {
    const int block = (column / 40) * 7 + (row / 60) * 3;
    return random() % 20 == 0 ? std::nan("") : noisy(1.0 + 0.3 * (block % 5));
  });
  Segmentation segmentation;
  segmentation.setMinSegmentSize(50);
  const auto segments = segmentsOf(segmentation, cloud);
  const std::vector<std::uint32_t> labels = segmentation.getLabels();
  ASSERT_GT(segments.size(), 10U);
  ASSERT_EQ(segments.size(), segmentation.getNumSegments());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    EXPECT_GE(segments[s].indices.size(), 50U);
    if (s > 0) {
      EXPECT_GE(segments[s - 1].indices.size(), segments[s].indices.size());
    }
    for (const auto index : segments[s].indices)
      ASSERT_EQ(labels[static_cast<std::size_t>(index)], s + 1);
  }
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (std::isnan(cloud[i].z)) {
      ASSERT_EQ(labels[i], 0U);
    }
  segmentsOf(segmentation, cloud);
  EXPECT_EQ(labels, segmentation.getLabels());
}

TEST(ConnectedGroups, labelAndColorCloudsFollowTheLabels)
{
  const Cloud cloud = cameraCloud(kCamera, [](int column, int) {
    return column < 5 ? std::nan("") : column < 160 ? 1.0 : 3.0;
  });
  Segmentation segmentation;
  EXPECT_TRUE(segmentation.getLabelCloud()->empty());
  ASSERT_EQ(segmentsOf(segmentation, cloud).size(), 2U);
  const auto label_cloud = segmentation.getLabelCloud();
  const auto color_cloud = segmentation.getColoredCloud();
  ASSERT_EQ(label_cloud->width, cloud.width);
  ASSERT_EQ(color_cloud->height, cloud.height);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ((*label_cloud)[i].label, segmentation.getLabels()[i]);
    const RGB color = labelColor((*label_cloud)[i].label);
    EXPECT_EQ((*color_cloud)[i].r, color.r);
    EXPECT_EQ((*color_cloud)[i].g, color.g);
  }
}

TEST(ConnectedGroups, hostileInputGivesNoSegments)
{
  const float nan = std::nanf("");
  Segmentation segmentation;
  std::vector<PointIndices> segments(3);
  segmentation.segment(segments); // no cloud at all
  EXPECT_TRUE(segments.empty());
  EXPECT_TRUE(segmentsOf(segmentation, Cloud()).empty());
  EXPECT_TRUE(segmentsOf(segmentation, Cloud(40, 30, PointXYZ(nan, nan, nan))).empty());
  EXPECT_TRUE(
      segmentsOf(segmentation, Cloud(1, 1, PointXYZ(1.0F, 1.0F, 1.0F))).empty());
  // All points in one place are one sheet, if a strange one.
  EXPECT_LE(segmentsOf(segmentation, Cloud(40, 30, PointXYZ(1.0F, 1.0F, 1.0F))).size(),
            1U);
}

TEST(ConnectedGroups, refusesForeignGraphs)
{
  const GridPoints points =
      toGridPoints(cameraCloud(kCamera, [](int, int) { return 1.0; }), kCamera);
  GridGraph graph;
  std::vector<std::uint32_t> labels;
  EXPECT_THROW(connectedGroups(points, graph, {}, {}, labels), std::invalid_argument);
  graph.build(points, {});
  ConnectedGroupsOptions options;
  options.jump_sigmas = 0.0F;
  EXPECT_THROW(connectedGroups(points, graph, {}, options, labels),
               std::invalid_argument);
}

TEST(ConnectedGroups, anyNumberOfThreadsGivesTheSame)
{
  const GridGeometry grid = GridGeometry::pinhole(200, 150, {170.0, 170.0, 99.5, 74.5});
  std::mt19937 random(9);
  std::normal_distribution<double> noise(0.0, 0.002);
  const Cloud cloud = cameraCloud(grid, [&](int column, int row) {
    const double box = column > 60 && column < 120 && row > 40 ? -0.4 : 0.0;
    return 2.0 + box + 0.004 * std::abs(column - 150) + noise(random);
  });
  std::vector<std::uint32_t> one;
  for (const unsigned int threads : {1U, 2U, 4U}) {
    ConnectedGroupsSegmentation<PointXYZ> segmentation;
    segmentation.setInputCloud(cloud.makeShared());
    segmentation.setNumberOfThreads(threads);
    std::vector<PointIndices> segments;
    segmentation.segment(segments);
    EXPECT_GE(segments.size(), 2U);
    if (threads == 1)
      one = segmentation.getLabels();
    EXPECT_EQ(segmentation.getLabels(), one);
  }
}

} // namespace
