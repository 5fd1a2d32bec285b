// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/kitti_calibration.h>

#include "input_file.h"

#include <cmath>
#include <map>
#include <sstream>
#include <vector>

namespace pcl {
namespace nurbs {
namespace {

/** Lines "name: numbers"; what is no number ends a line. */
std::map<std::string, std::vector<double>>
namedNumbers(const InputFile& file)
{
  std::map<std::string, std::vector<double>> result;
  std::istringstream lines(file.bytes);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos)
      continue;
    std::istringstream words(line.substr(colon + 1));
    std::vector<double>& numbers = result[line.substr(0, colon)];
    for (double number = 0.0; words >> number;)
      numbers.push_back(number);
  }
  return result;
}

/** The nearest rotation: the digits of the file end somewhere. */
Eigen::Matrix3d
nearestRotation(const Eigen::Matrix3d& matrix)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

} // namespace

Eigen::Isometry3d
readKittiCalibration(const std::string& path)
{
  constexpr std::size_t kLargest = std::size_t{1} << 20U;
  constexpr double kMostOff = 1e-3;
  const InputFile file = loadInputFile(path, kLargest);
  auto named = namedNumbers(file);
  std::vector<double> n = named["Tr"];
  if (n.empty())
    n = named["Tr_velo_to_cam"];
  const std::vector<double>& r = named["R"];
  const std::vector<double>& t = named["T"];
  if (n.empty() && r.size() == 9 && t.size() == 3)
    n = {r[0], r[1], r[2], t[0], r[3], r[4], r[5], t[1], r[6], r[7], r[8], t[2]};
  if (n.size() != 12)
    file.fail("has no line \"Tr:\" of 12 numbers, nor \"R:\" and \"T:\"");
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> matrix(n.data());
  const Eigen::Matrix3d rotation = matrix.leftCols<3>();
  if (!matrix.allFinite() || !(rotation * rotation.transpose()).isIdentity(kMostOff) ||
      rotation.determinant() < 0.0)
    file.fail("the motion from laser to camera is not rigid");
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = nearestRotation(rotation);
  result.translation() = matrix.col(3);
  return result;
}

Eigen::Isometry3d
nominalKittiCalibration()
{
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() << 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0;
  result.translation() = Eigen::Vector3d(0.0, -0.08, -0.27);
  return result;
}

Trajectory
inLaserFrame(Trajectory camera_poses, const Eigen::Isometry3d& T_camera_laser)
{
  const Eigen::Isometry3d back = T_camera_laser.inverse();
  for (StampedPose& pose : camera_poses)
    pose.T_world_body = back * pose.T_world_body * T_camera_laser;
  return camera_poses;
}

} // namespace nurbs
} // namespace pcl
