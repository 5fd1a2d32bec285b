// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Surface grouping of real and simulated scans: few groups hold what is there.

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/demo_scene.h>
#include <pcl/segmentation/cloud_organizer.h>
#include <pcl/segmentation/surface_grouping.h>

#include "label_checks.h"
#include "test_data.h"

#include <gtest/gtest.h>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

struct Grouping {
  GridPoints points;
  LabelImage labels;
  std::vector<SurfaceGroup> groups;

  std::size_t
  labelled() const
  {
    std::size_t sum = 0;
    for (const SurfaceGroup& group : groups)
      sum += group.size;
    return sum;
  }

  /** Number of the largest groups that hold a share of the labelled points. */
  std::size_t
  groupsFor(double share) const
  {
    std::size_t count = 0;
    double sum = 0.0;
    while (count < groups.size() && sum < share * static_cast<double>(labelled()))
      sum += static_cast<double>(groups[count++].size);
    return count;
  }
};

Grouping
groupCloud(const PointCloud<PointXYZ>::Ptr& cloud)
{
  CloudOrganizer<PointXYZ> organizer;
  organizer.setInputCloud(cloud);
  PointCloud<PointXYZ> organized;
  organizer.organize(organized);
  Grouping result;
  result.points = toGridPoints(organized, organizer.getGeometry());
  const SensorNoise noise = SensorNoise::estimate(result.points);
  GridGraph graph;
  graph.build(result.points, noise);
  graph.setWeights();
  groupSurfaces(result.points, graph, noise, {}, result.labels, &result.groups);
  return result;
}

TEST(RealGrouping, demoSceneIsItsSurfaces)
{
  const DemoScene demo;
  const Grouping grouping = groupCloud(demo.cloud());
  EXPECT_LE(grouping.groups.size(), demo.numSurfaces() + 3U);
  EXPECT_GT(accuracy(demo.labels(), grouping.labels), 0.97);
}

TEST(RealGrouping, tableTopIsFewGroups)
{
  PCL_NURBS_DATA_OR_SKIP(file, "osd_labelled/learn33.pcd");
  const Grouping grouping = groupCloud(readCloud(file.string()).cloud);
  EXPECT_LE(grouping.groups.size(), 20U);
  EXPECT_LE(grouping.groupsFor(0.9), 5U);
}

TEST(RealGrouping, roadAndWallsOfAStreetAreWhole)
{
  PCL_NURBS_DATA_OR_SKIP(file, "kitti_odometry/sequences/07/velodyne/000000.bin");
  const Grouping grouping = groupCloud(readCloud(file.string()).cloud);
  EXPECT_LE(grouping.groups.size(), 110U);
  EXPECT_LE(grouping.groupsFor(0.5), 8U);
  EXPECT_GT(static_cast<double>(grouping.labelled()),
            0.75 * static_cast<double>(
                       std::count_if(grouping.points.depth.begin(),
                                     grouping.points.depth.end(),
                                     [](float depth) { return !std::isnan(depth); })));
}

} // namespace
