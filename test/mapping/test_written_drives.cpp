// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Simulated drives written in public layouts and read back: the points, times and poses
// that the simulator gave, within the rounding of the format.

#include "cloud_files.h"
#include "town_drives.h"

#include <pcl/mapping/scan_readers.h>
#include <pcl/mapping/simulator/drive_writer.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

class WrittenDrives : public CloudFiles {
protected:
  static constexpr std::size_t kFirst = 2; // of the scans written
  static constexpr std::size_t kCount = 3;

  DriveWriteOptions
  part() const
  {
    DriveWriteOptions writing;
    writing.first = kFirst;
    writing.count = kCount;
    writing.labels = true;
    return writing;
  }

  /** As many scans as were written, with their times and poses. */
  void
  expectTimesAndPoses(const ScanSource& source, const SimulatedDrive& drive) const
  {
    ASSERT_EQ(source.size(), kCount);
    ASSERT_NE(source.truth(), nullptr);
    ASSERT_EQ(source.truth()->size(), kCount);
    EXPECT_TRUE(source.problems().empty());
    EXPECT_TRUE(source.calibration().isApprox(drive.calibration(), 1e-9));
    for (std::size_t k = 0; k < kCount; ++k) {
      const StampedPose& read = (*source.truth())[k];
      const StampedPose& given = (*drive.truth())[kFirst + k];
      EXPECT_NEAR(source.stamp(k), drive.stamp(kFirst + k), 1e-9);
      EXPECT_NEAR(read.stamp, given.stamp, 1e-9);
      EXPECT_LT((read.T_world_body.matrix() - given.T_world_body.matrix()).norm(),
                2e-6);
    }
  }
};

/** The points with a return, beam by beam: single precision is kept as it is. */
void
expectSamePoints(const Scan& read, const Scan& given)
{
  std::size_t next = 0;
  for (std::size_t i = 0; i < given.cloud->size(); ++i) {
    const pcl::PointXYZI& point = (*given.cloud)[i];
    if (!std::isfinite(point.x))
      continue;
    ASSERT_LT(next, read.cloud->size());
    ASSERT_EQ((*read.cloud)[next].getVector3fMap(), point.getVector3fMap());
    ASSERT_EQ((*read.cloud)[next].intensity, point.intensity);
    if (!given.point_times.empty()) {
      ASSERT_EQ(read.point_times.at(next), given.point_times[i]);
    }
    ++next;
  }
  EXPECT_EQ(next, read.cloud->size());
  EXPECT_GT(next, 1000U);
  EXPECT_EQ(read.point_times.empty(), given.point_times.empty());
}

TEST_F(WrittenDrives, lasersInKittiLayout)
{
  LaserModel few = LaserModel::vlp16();
  few.columns = 200;
  for (const LaserModel& laser : {coarseLaser(300), few})
    for (const bool distortion : {false, true}) {
      SimulationOptions options;
      options.motion_distortion = distortion;
      const SimulatedDrive drive(shortDrive(8), laser, options);
      ASSERT_EQ(writeKittiDrive(drive, folder.string(), part()), kCount);
      const auto source = openKittiOdometry(folder.string(), "00");
      expectTimesAndPoses(*source, drive);
      for (std::size_t k = 0; k < kCount; ++k)
        expectSamePoints(source->read(k), drive.read(kFirst + k));
      std::filesystem::remove_all(folder / "sequences");
    }
}

/** Depths come in steps of 0.2 mm; what lies off the axis is off by that much more. */
void
expectSameDepths(const Scan& read,
                 const Scan& given,
                 const pcl::PinholeIntrinsics& lens)
{
  constexpr float kHalfStep = 1e-4F;
  constexpr float kSingle = 1e-5F; // rounding of what a float holds up to 8 m
  ASSERT_EQ(read.cloud->width, given.cloud->width);
  ASSERT_EQ(read.cloud->height, given.cloud->height);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < given.cloud->size(); ++i) {
    const Eigen::Vector3f point = (*read.cloud)[i].getVector3fMap();
    const Eigen::Vector3f wanted = (*given.cloud)[i].getVector3fMap();
    ASSERT_EQ(std::isfinite(point.z()), std::isfinite(wanted.z())) << i;
    if (!std::isfinite(wanted.z()))
      continue;
    ++seen;
    const std::size_t column = i % given.cloud->width;
    const std::size_t row = i / given.cloud->width;
    const auto x =
        static_cast<float>(std::abs(static_cast<double>(column) - lens.cx) / lens.fx);
    const auto y =
        static_cast<float>(std::abs(static_cast<double>(row) - lens.cy) / lens.fy);
    ASSERT_NEAR(point.z(), wanted.z(), kHalfStep + kSingle) << i;
    ASSERT_NEAR(point.x(), wanted.x(), x * kHalfStep + kSingle) << i;
    ASSERT_NEAR(point.y(), wanted.y(), y * kHalfStep + kSingle) << i;
  }
  EXPECT_GT(seen, given.cloud->size() / 20);
}

TEST_F(WrittenDrives, aDepthCameraInTumLayout)
{
  DepthCameraModel half = DepthCameraModel::kinect();
  half.width = 320;
  half.height = 240;
  half.intrinsics = {262.5, 262.5, 159.5, 119.5};
  DepthCameraModel small = DepthCameraModel::kinect();
  small.width = 80;
  small.height = 60;
  small.intrinsics = {65.0, 66.0, 39.0, 30.0};
  SimulationOptions
      options; // three metres to the right, looking there and down a little
  options.T_body_sensor.linear() << -1, 0, 0, 0, 0, -1, 0, -1, 0;
  options.T_body_sensor.rotate(
      Eigen::AngleAxisd(-0.2, Eigen::Vector3d(1.0, 0.1, 0.05).normalized()));
  options.T_body_sensor.translation().y() = -3.0;
  for (const DepthCameraModel& camera : {half, small}) {
    Trajectory path = shortDrive(8);
    for (StampedPose& pose : path)
      pose.stamp /= 3.0; // 30 images a second, times that no decimal fraction is
    const SimulatedDrive drive(path, camera, options);
    ASSERT_EQ(writeTumDrive(drive, folder.string(), part()), kCount);
    const auto source = openDepthSequence(folder.string());
    expectTimesAndPoses(*source, drive);
    for (std::size_t k = 0; k < kCount; ++k) {
      const Scan read = source->read(k);
      ASSERT_TRUE(read.geometry);
      EXPECT_NEAR(read.geometry->intrinsics().fx, camera.intrinsics.fx, 1e-6);
      EXPECT_NEAR(read.geometry->intrinsics().cy, camera.intrinsics.cy, 1e-6);
      expectSameDepths(read, drive.read(kFirst + k), camera.intrinsics);
    }
  }
}

} // namespace
