// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Data sets on disk, and every kind of fault. What comes back of a simulated drive is
// in test_written_drives.cpp.

#include "cloud_files.h"

#include <pcl/mapping/kitti_calibration.h>
#include <pcl/mapping/scan_readers.h>
#include <pcl/mapping/simulator/circuits.h>
#include <pcl/mapping/simulator/drive_writer.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;
namespace fs = std::filesystem;

class ScanReaders : public CloudFiles {
protected:
  /** A drive of so many scans of a small laser below the folder, in KITTI's layout. */
  void
  writeDrive(std::size_t scans)
  {
    CircuitOptions circuit;
    circuit.laps = 0.1;
    LaserModel laser = LaserModel::vlp16();
    laser.columns = 60;
    drive = std::make_unique<SimulatedDrive>(makeCircuit(circuit), laser);
    DriveWriteOptions writing;
    writing.count = scans;
    ASSERT_EQ(writeKittiDrive(*drive, folder.string(), writing), scans);
  }

  std::unique_ptr<ScanSource>
  open(bool skip = false) const
  {
    ScanReadOptions options;
    options.skip_faults = skip;
    return openKittiOdometry(folder.string(), "00", options);
  }

  /** Refused with a line that names a file; with skipping, so many scans are left. */
  void
  expectFault(const std::string& named, std::size_t left) const
  {
    try {
      open();
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(named), std::string::npos)
          << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
    const auto source = open(true);
    EXPECT_EQ(source->size(), left);
    ASSERT_FALSE(source->problems().empty());
    EXPECT_NE(source->problems()[0].find(named), std::string::npos)
        << source->problems()[0];
  }

  std::unique_ptr<SimulatedDrive> drive;
  const std::string velodyne = "sequences/00/velodyne/";
};

TEST_F(ScanReaders, verticalCorrectionTurnsUpAndKeepsRanges)
{
  writeDrive(1);
  ScanReadOptions options;
  options.correct_vertical_angles = true;
  const Scan turned = openKittiOdometry(folder.string(), "00", options)->read(0);
  const Scan plain = open()->read(0);
  for (std::size_t i = 0; i < plain.cloud->size(); ++i) {
    const Eigen::Vector3d a = (*plain.cloud)[i].getVector3fMap().cast<double>();
    const Eigen::Vector3d b = (*turned.cloud)[i].getVector3fMap().cast<double>();
    const auto elevation = [](const Eigen::Vector3d& p) {
      return std::atan2(p.z(), p.head<2>().norm()) * 180.0 / M_PI;
    };
    ASSERT_NEAR(elevation(b) - elevation(a), 0.205, 1e-4);
    ASSERT_NEAR(b.norm(), a.norm(), 1e-5 * a.norm());
    ASSERT_NEAR(std::atan2(b.y(), b.x()), std::atan2(a.y(), a.x()), 1e-6);
  }
}

TEST_F(ScanReaders, emptyAndMissingFoldersAreNamed)
{
  EXPECT_THROW(open(), InputError);
  fs::create_directories(folder / velodyne);
  EXPECT_THROW(open(), InputError);
  EXPECT_THROW(open(true), InputError);
  EXPECT_THROW(openCloudFolder(folder.string()), InputError);
  EXPECT_THROW(openDepthSequence(folder.string()), InputError);
  EXPECT_THROW(openKittiRaw(folder.string()), InputError);
}

TEST_F(ScanReaders, oneScanIsEnough)
{
  writeDrive(1);
  EXPECT_EQ(open()->size(), 1U);
  EXPECT_THROW(open()->read(1), std::invalid_argument);
  EXPECT_THROW(open()->stamp(1), std::invalid_argument);
}

TEST_F(ScanReaders, missingScanInBetween)
{
  writeDrive(4);
  fs::remove(folder / (velodyne + "000001.bin"));
  expectFault("000002.bin", 3);
  const auto source = open(true);
  EXPECT_NEAR(source->stamp(1), 0.2, 1e-9); // the third scan keeps its time and pose
  EXPECT_TRUE((*source->truth())[1].T_world_body.isApprox(
      (*drive->truth())[2].T_world_body, 1e-8));
}

TEST_F(ScanReaders, tornAndForeignScans)
{
  writeDrive(4);
  fs::resize_file(path(velodyne + "000001.bin"), 1003);
  expectFault("000001.bin", 3);
  write(velodyne + "000001.bin", "\x89PNG and no laser");
  expectFault("000001.bin", 3);
  write(velodyne + "000001.bin", "");
  expectFault("000001.bin", 3);
  // The size fits but the content does not: found when it is read.
  write(velodyne + "000001.bin", std::string(1600, '\x7f'));
  EXPECT_THROW(open()->read(1), InputError);
  EXPECT_NO_THROW(open()->read(2));
}

TEST_F(ScanReaders, calibrationMissingOrWrong)
{
  writeDrive(2);
  write("sequences/00/calib.txt", "P0: 1 2 3\n");
  expectFault("calib.txt", 2);
  write("sequences/00/calib.txt", "Tr: 2 0 0 0 0 2 0 0 0 0 2 0\n");
  expectFault("calib.txt", 2);
  fs::remove(folder / "sequences/00/calib.txt");
  expectFault("calib.txt", 2);
  EXPECT_EQ(open(true)->truth(), nullptr);
  fs::remove(folder / "poses/00.txt"); // without poses none is needed
  EXPECT_EQ(open()->size(), 2U);
}

TEST_F(ScanReaders, posesThatAreNoPoses)
{
  writeDrive(2);
  write("poses/00.txt", "1 0 0 nan 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n");
  expectFault("poses/00.txt", 2);
  EXPECT_EQ(open(true)->truth(), nullptr);
  write("poses/00.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  expectFault("poses/00.txt", 2);
}

TEST_F(ScanReaders, timesBackwardsOrMissing)
{
  writeDrive(4);
  write("sequences/00/times.txt", "0\n0.2\n0.1\n0.3\n");
  expectFault("000002.bin", 3);
  EXPECT_EQ(open(true)->truth()->size(), 3U);
  write("sequences/00/times.txt", "0\n0.1\n");
  expectFault("times.txt", 2);
  write("sequences/00/times.txt", "0\nsoon\n");
  expectFault("times.txt", 4);
  fs::remove(folder / "sequences/00/times.txt");
  EXPECT_NEAR(open()->stamp(3), 0.3, 1e-12);
}

TEST_F(ScanReaders, rawLayoutHasClockTimes)
{
  writeDrive(3);
  fs::create_directories(folder / "velodyne_points");
  fs::rename(folder / velodyne, folder / "velodyne_points/data");
  write("velodyne_points/timestamps.txt",
        "2011-09-26 23:59:59.900000000\n2011-09-27 00:00:00.000000000\n"
        "2011-09-27 00:00:00.103500000\n");
  write("calib_velo_to_cam.txt",
        "calib_time: 15-Mar-2012 11:37:16\nR: 0 -1 0 0 0 -1 1 0 0\nT: 0 -0.08 -0.27\n");
  const auto source = openKittiRaw(folder.string());
  ASSERT_EQ(source->size(), 3U);
  EXPECT_EQ(source->truth(), nullptr);
  EXPECT_NEAR(source->stamp(1), 0.1, 1e-9);
  EXPECT_NEAR(source->stamp(2), 0.2035, 1e-9);
  EXPECT_TRUE(source->calibration().isApprox(nominalKittiCalibration()));
  write("velodyne_points/timestamps.txt", "yesterday\n");
  EXPECT_THROW(openKittiRaw(folder.string()), InputError);
}

TEST_F(ScanReaders, depthListsWithFaults)
{
  writeDepth(path("a.png"), std::vector<std::uint16_t>(12, 5000), 4);
  write("depth.txt", "# stamp file\n0.0 a.png\n0.1 b.png\nnever a.png\n0.2\n");
  EXPECT_THROW(openDepthSequence(folder.string()), InputError);
  ScanReadOptions options;
  options.skip_faults = true;
  const auto source = openDepthSequence(folder.string(), options);
  EXPECT_EQ(source->size(), 1U);
  EXPECT_EQ(source->problems().size(), 3U);
  EXPECT_NEAR((*source->read(0).cloud)[0].z, 1.0, 1e-6);
  options.cloud.depth_scale = 1000.0;
  EXPECT_NEAR(
      (*openDepthSequence(folder.string(), options)->read(0).cloud)[0].z, 5.0, 1e-6);
  write("intrinsics.txt", "1 2 3\n");
  EXPECT_THROW(openDepthSequence(folder.string(), options), InputError);
}

TEST_F(ScanReaders, truthBetweenPosesIsInterpolated)
{
  writeDepth(path("a.png"), std::vector<std::uint16_t>(12, 5000), 4);
  write("depth.txt", "1.05 a.png\n");
  write("groundtruth.txt", "1.0 0 0 0 0 0 0 1\n1.1 2 0 0 0 0 0.6 0.8\n");
  const auto source = openDepthSequence(folder.string());
  const Eigen::Isometry3d pose = source->truth()->front().T_world_body;
  EXPECT_NEAR(pose.translation().x(), 1.0, 1e-12);
  EXPECT_NEAR(Eigen::AngleAxisd(pose.linear()).angle(), std::asin(0.6), 1e-9);
  write("groundtruth.txt", "1.0 0 0 0 0 0 0 1\n3.0 2 0 0 0 0 0 1\n");
  EXPECT_THROW(openDepthSequence(folder.string()), InputError);
}

} // namespace
