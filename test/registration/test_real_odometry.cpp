// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Odometry on KITTI scans against the official poses.

#include <pcl/registration/scan_odometry.h>

#include "test_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <vector>

namespace {

using namespace pcl::nurbs;

ScanPoints
readBin(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  ScanPoints points;
  for (float row[4]; file.read(reinterpret_cast<char*>(row), sizeof(row));)
    points.emplace_back(row[0], row[1], row[2]);
  return points;
}

Eigen::Isometry3d
readPose(std::istream& stream)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c)
      stream >> pose.matrix()(r, c);
  return pose;
}

/** Tr: from the laser's frame to the camera's. */
Eigen::Isometry3d
readCalibration(const std::filesystem::path& path)
{
  std::ifstream file(path);
  std::string word;
  while (file >> word && word != "Tr:")
    continue;
  return readPose(file);
}

/** Error at the end of a drive, as a share of its length. */
double
endError(const std::filesystem::path& scans,
         const std::filesystem::path& poses,
         const Eigen::Isometry3d& calibration)
{
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(scans))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ScanOdometry odometry;
  std::ifstream truth(poses);
  Eigen::Isometry3d first;
  Eigen::Isometry3d last;
  Eigen::Isometry3d estimate;
  double way = 0.0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const Eigen::Isometry3d pose =
        calibration.inverse() * readPose(truth) * calibration;
    way += i == 0 ? 0.0 : (pose.translation() - last.translation()).norm();
    first = i == 0 ? pose : first;
    last = pose;
    const OdometryResult result = odometry.process(readBin(files[i]));
    EXPECT_TRUE(result.tracked) << files[i];
    estimate = result.pose;
  }
  return ((first.inverse() * last).inverse() * estimate).translation().norm() / way;
}

TEST(RealOdometry, MotorwayCurve)
{
  PCL_NURBS_DATA_OR_SKIP(kitti, "kitti_odometry");
  const auto calibration = readCalibration(kitti / "sequences/01/calib.txt");
  EXPECT_LT(endError(kitti / "sequences/01_thin3/velodyne",
                     kitti / "poses/01.txt",
                     calibration),
            0.01);
}

TEST(RealOdometry, ThreeFullScans)
{
  PCL_NURBS_DATA_OR_SKIP(kitti, "kitti_odometry");
  const auto calibration = readCalibration(kitti / "sequences/07/calib.txt");
  // A few centimetres of way: five millimetres are much of it.
  EXPECT_LT(
      endError(kitti / "sequences/07/velodyne", kitti / "poses/07.txt", calibration),
      0.1);
}

} // namespace
