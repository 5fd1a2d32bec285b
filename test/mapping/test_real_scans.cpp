// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Readers on samples of public data sets.

#include "test_data.h"

#include <pcl/mapping/scan_readers.h>

#include <gtest/gtest.h>

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
