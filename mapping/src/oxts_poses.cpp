// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "oxts_poses.h"

#include "scan_files.h"

#include <cmath>

namespace pcl {
namespace nurbs {

OxtsRecord
readOxts(const std::filesystem::path& file)
{
  constexpr std::size_t kUsed = 6;
  const auto lines = wordsOf(file);
  if (lines.empty() || lines.front().size() < kUsed)
    throw InputError(file.string(), "does not begin with six numbers");
  std::vector<double> n;
  for (std::size_t k = 0; k < kUsed; ++k)
    n.push_back(numberOf(file, lines.front()[k]));
  if (std::abs(n[0]) >= 90.0)
    throw InputError(file.string(), "its latitude is not between the poles");
  return {n[0], n[1], n[2], n[3], n[4], n[5]};
}

Eigen::Isometry3d
poseOnMap(const OxtsRecord& record, double scale_latitude)
{
  constexpr double kEarthRadius = 6378137.0; // metres
  constexpr double kDegree = M_PI / 180.0;
  const double scale = kEarthRadius * std::cos(scale_latitude * kDegree);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(
      scale * record.longitude * kDegree,
      scale * std::log(std::tan((90.0 + record.latitude) * kDegree / 2)),
      record.altitude);
  pose.linear() = (Eigen::AngleAxisd(record.yaw, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(record.pitch, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(record.roll, Eigen::Vector3d::UnitX()))
                      .matrix();
  return pose;
}

} // namespace nurbs
} // namespace pcl
