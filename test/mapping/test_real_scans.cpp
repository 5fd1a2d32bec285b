// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Readers on samples of public data sets.

#include "test_data.h"

#include <pcl/mapping/scan_readers.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>

namespace {

using namespace pcl::nurbs;

/** A sample of a public data set opens without a fault and its first scan has points.
 */
void
expectGood(const ScanSource& source, std::size_t scans, bool truth)
{
  EXPECT_EQ(source.size(), scans);
  EXPECT_TRUE(source.problems().empty());
  ASSERT_EQ(source.truth() != nullptr, truth);
  if (truth) {
    EXPECT_EQ(source.truth()->size(), scans);
  }
  EXPECT_GT(source.read(source.size() - 1).cloud->size(), 5000U);
}

TEST(RealDataSets, kittiOdometry)
{
  PCL_NURBS_DATA_OR_SKIP(root, "kitti_odometry");
  const auto source = openKittiOdometry(root.string(), "07");
  expectGood(*source, 3, true);
  // The laser's truth looks ahead along x where the vehicle goes.
  const Eigen::Vector3d move = (*source->truth())[2].T_world_body.translation() -
                               (*source->truth())[0].T_world_body.translation();
  EXPECT_GT(move.x(), 0.95 * move.norm());
  expectGood(*openKittiOdometry(root.string(), "00"), 8, true);
  ScanReadOptions options;
  options.poses_path = (root / "poses/01.txt").string();
  expectGood(*openKittiOdometry(root.string(), "01_thin3", options), 40, true);
}

TEST(RealDataSets, kittiRaw)
{
  PCL_NURBS_DATA_OR_SKIP(root, "kitti_raw/sfnd_data_1_thin4");
  expectGood(*openKittiRaw(root.string()), 22, false);
}

/** Drives of KITTI's raw data that come with the vehicle's navigation. */
std::vector<std::filesystem::path>
drivesWithNavigation(const std::filesystem::path& root)
{
  std::vector<std::filesystem::path> drives;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
    if (entry.path().filename() == "oxts" &&
        std::filesystem::exists(entry.path() / "data"))
      drives.push_back(entry.path().parent_path());
  return drives;
}

/** Speed ahead, which the navigation measures beside the place: the ninth number. */
double
speedAhead(const std::filesystem::path& drive, std::size_t index)
{
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%010zu.txt", index);
  std::ifstream file(drive / "oxts/data" / name.data());
  double number = 0.0;
  for (int k = 0; k < 9; ++k)
    file >> number;
  EXPECT_TRUE(file) << drive << ' ' << name.data();
  return number;
}

TEST(RealDataSets, navigationOfKittiRawMovesAsFastAsItSays)
{
  PCL_NURBS_DATA_OR_SKIP(root, "kitti_raw");
  const auto drives = drivesWithNavigation(root);
  if (drives.empty())
    GTEST_SKIP() << "no drive in " << root << " has oxts/";
  for (const std::filesystem::path& drive : drives) {
    const auto source = openKittiRaw(drive.string());
    ASSERT_NE(source->truth(), nullptr);
    const Trajectory& truth = *source->truth();
    ASSERT_EQ(truth.size(), source->size());
    for (std::size_t k = 1; k < truth.size(); ++k) {
      const Eigen::Isometry3d step =
          truth[k - 1].T_world_body.inverse() * truth[k].T_world_body;
      const double seconds = truth[k].stamp - truth[k - 1].stamp;
      const double ahead =
          0.5 * (speedAhead(drive, k - 1) + speedAhead(drive, k)) * seconds;
      // The laser is a metre from what the navigation gives the speed of.
      const double turned = Eigen::AngleAxisd(step.linear()).angle();
      EXPECT_NEAR(step.translation().x(), ahead, 0.03 + 0.03 * ahead + turned) << k;
    }
  }
}

TEST(RealDataSets, folderOfScansWithPosesAndTimesAbove)
{
  PCL_NURBS_DATA_OR_SKIP(root, "balm_realworld/velodyne");
  const auto source = openCloudFolder(root.string());
  expectGood(*source, 64, true);
  EXPECT_NEAR(source->stamp(1), 0.999227, 1e-9);
}

TEST(RealDataSets, depthCameras)
{
  PCL_NURBS_DATA_OR_SKIP(root, "tum_fr1_desk");
  expectGood(*openDepthSequence(root.string()), 9, true);
  PCL_NURBS_DATA_OR_SKIP(icl, "icl_nuim_lr_kt0");
  expectGood(*openDepthSequence(icl.string()), 3, true);
  ScanReadOptions millimetres;
  millimetres.cloud.depth_scale = 1000.0;
  PCL_NURBS_DATA_OR_SKIP(redwood, "redwood_livingroom");
  expectGood(*openDepthSequence(redwood.string(), millimetres), 5, true);
  PCL_NURBS_DATA_OR_SKIP(kitchen, "seven_scenes_redkitchen");
  const auto source = openDepthSequence(kitchen.string(), millimetres);
  expectGood(*source, 130, true);
  EXPECT_EQ(source->read(0).geometry->intrinsics().fx, 585.0);
}

} // namespace
