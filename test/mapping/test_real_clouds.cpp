// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Every kind of real cloud at hand loads, gets the right raster, keeps nine tenths of
// its points, and falls into sensible groups.

#include <pcl/mapping/cloud_reader.h>
#include <pcl/segmentation/cloud_organizer.h>
#include <pcl/segmentation/grid_segmentation.h>

#include "data_files.h"
#include "test_data.h"

#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

#include <map>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

struct Source {
  const char* folder;
  const char* extension;
  std::optional<GridProjection> projection;
  CloudReadOptions options;
  double most_dropped = 0.1;
  double least_labelled = 0.7; // of the points that found a cell
};

class RealClouds : public testing::TestWithParam<Source> {};

TEST_P(RealClouds, loadOrganizeAndSegment)
{
  PCL_NURBS_DATA_OR_SKIP(folder, GetParam().folder);
  const auto files = filesIn(folder, GetParam().extension, 3);
  ASSERT_FALSE(files.empty());
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename().string());
    const InputCloud input = readCloud(file.string(), GetParam().options);
    CloudOrganizer<PointXYZ> organizer;
    organizer.setInputCloud(input.cloud);
    auto organized = pcl::make_shared<PointCloud<PointXYZ>>();
    ASSERT_TRUE(organizer.organize(*organized));
    if (GetParam().projection) {
      EXPECT_EQ(organizer.getGeometry().projection, *GetParam().projection);
    }
    std::size_t kept = 0;
    for (const std::int32_t index : organizer.getCellPoints())
      kept += index >= 0 ? 1 : 0;
    const auto dropped = static_cast<double>(organizer.getNumDropped());
    EXPECT_LE(dropped, GetParam().most_dropped * (static_cast<double>(kept) + dropped));
    ConnectedGroupsSegmentation<PointXYZ> segmentation;
    segmentation.setInputCloud(organized);
    segmentation.setGeometry(organizer.getGeometry());
    std::vector<PointIndices> segments;
    segmentation.segment(segments);
    std::size_t labelled = 0;
    for (const PointIndices& segment : segments)
      labelled += segment.indices.size();
    EXPECT_GT(segments.size(), 0U);
    EXPECT_GE(static_cast<double>(labelled),
              GetParam().least_labelled * static_cast<double>(kept));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Data,
    RealClouds,
    testing::Values(
        Source{"pcl_organized", ".pcd", GridProjection::perspective, {}},
        Source{"osd_labelled", ".pcd", GridProjection::perspective, {}},
        Source{"synpeb_room", ".pcd", GridProjection::spherical, {}},
        Source{"pcl_unorganized", ".pcd", {}, {}},
        Source{"isprs_urban_als", ".pcd", GridProjection::plane, {}},
        Source{"registration_pairs", ".ply", GridProjection::spherical, {}},
        Source{"kitti_odometry/sequences/00", ".bin", GridProjection::spherical, {}},
        Source{"kitti_odometry/sequences/07", ".bin", GridProjection::spherical, {}},
        Source{
            "kitti_odometry/sequences/01_thin3", ".bin", GridProjection::spherical, {}},
        Source{"kitti_raw", ".bin", GridProjection::spherical, {}},
        Source{"balm_realworld", ".bin", GridProjection::spherical, {}},
        // Several scans from several places: layered in every projection.
        Source{"kitti_07_submaps", ".bin", {}, withoutReflectance(), 0.25, 0.55},
        Source{"tum_fr1_desk/depth",
               ".png",
               GridProjection::perspective,
               depthScale(5000)},
        Source{"icl_nuim_lr_kt0/depth",
               ".png",
               GridProjection::perspective,
               depthScale(5000)},
        Source{"seven_scenes_redkitchen", ".png", GridProjection::perspective, {}},
        Source{"redwood_bollard", ".png", GridProjection::perspective, {}},
        Source{"synthetic_knot", ".png", GridProjection::perspective, {}}),
    [](const testing::TestParamInfo<Source>& info) {
      std::string name = info.param.folder;
      std::replace_if(
          name.begin(), name.end(), [](char c) { return std::isalnum(c) == 0; }, '_');
      return name;
    });

TEST(RealClouds, kittiHasItsSixtyFourRings)
{
  PCL_NURBS_DATA_OR_SKIP(scan, "kitti_odometry/sequences/00/velodyne/000000.bin");
  CloudOrganizer<PointXYZ> organizer;
  organizer.setInputCloud(readCloud(scan.string()).cloud);
  PointCloud<PointXYZ> organized;
  ASSERT_TRUE(organizer.organize(organized));
  EXPECT_EQ(organizer.getGeometry().row_v.size(), 64U);
  EXPECT_TRUE(organizer.getGeometry().wrap);
}

TEST(RealClouds, sunDepthBitsAreRotated)
{
  PCL_NURBS_DATA_OR_SKIP(image, "single_frames/SUN_depth.png");
  CloudReadOptions options;
  options.rotated_depth_bits = true;
  const InputCloud input = readCloud(image.string(), options);
  std::vector<float> depths;
  for (const PointXYZ& point : *input.cloud)
    if (!std::isnan(point.z))
      depths.push_back(point.z);
  std::sort(depths.begin(), depths.end());
  // A corridor; without the rotation its depths would reach to 65 m.
  EXPECT_NEAR(static_cast<double>(depths.size()) / input.cloud->size(), 0.82, 0.01);
  EXPECT_NEAR(depths[depths.size() / 100], 1.1F, 0.1F);
  EXPECT_NEAR(depths[depths.size() * 99 / 100], 8.8F, 0.1F);
}

/** Share of the labelled pixels that lie in a group whose main label is theirs. */
TEST(RealClouds, groupsAreNearlyPureOnLabelledScenes)
{
  PCL_NURBS_DATA_OR_SKIP(folder, "osd_labelled");
  double pure = 0.0;
  double all = 0.0;
  for (const auto& file : filesIn(folder, ".pcd", 99)) {
    PointCloud<PointXYZL> truth;
    ASSERT_EQ(io::loadPCDFile(file.string(), truth), 0);
    ConnectedGroupsSegmentation<PointXYZL> segmentation;
    segmentation.setInputCloud(truth.makeShared());
    std::vector<PointIndices> segments;
    segmentation.segment(segments);
    for (const PointIndices& segment : segments) {
      std::map<std::uint32_t, double> labels;
      double most = 0.0;
      for (const auto index : segment.indices)
        most = std::max(most, ++labels[truth[static_cast<std::size_t>(index)].label]);
      pure += most;
      all += static_cast<double>(segment.indices.size());
    }
  }
  RecordProperty("purity", std::to_string(pure / all));
  std::printf("purity on labelled scenes: %.3f\n", pure / all);
  EXPECT_GT(pure / all, 0.85);
}

} // namespace
