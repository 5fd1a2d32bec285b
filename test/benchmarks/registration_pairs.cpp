// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "registration_pairs.h"

#include "test_data.h"

#include <pcl/mapping/scan_readers.h>
#include <pcl/mapping/simulator/circuits.h>
#include <pcl/mapping/simulator/simulated_drive.h>
#include <pcl/registration/scan_preprocessing.h>

#include <functional>
#include <map>
#include <utility>

namespace pcl {
namespace nurbs {
namespace bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
/** Numbers of target and source. */
using Choice = std::vector<std::pair<std::size_t, std::size_t>>;

struct Crop {
  float nearest;
  float farthest;
};

Cloud::Ptr
prepared(const Scan& scan, const Crop& crop, double spacing)
{
  ScanPoints points;
  for (const Eigen::Vector3f& point : finitePoints(*scan.cloud))
    if (point.norm() >= crop.nearest && point.norm() <= crop.farthest)
      points.push_back(point);
  Cloud::Ptr cloud(new Cloud);
  for (const Eigen::Vector3f& point : voxelSubsample(points, spacing))
    cloud->emplace_back(point.x(), point.y(), point.z());
  return cloud;
}

/** The chosen pairs of a source of scans. */
PairSet
fill(PairSet set, const ScanSource& source, const Choice& choice, const Crop& crop)
{
  for (const auto& [first, second] : choice) {
    const Eigen::Isometry3d target =
        poseAt(*source.truth(), source.stamp(first)).T_world_body;
    set.pairs.push_back(
        {prepared(source.read(first), crop, set.spacing),
         prepared(source.read(second), crop, set.spacing),
         target.inverse() *
             poseAt(*source.truth(), source.stamp(second)).T_world_body});
  }
  return set;
}

constexpr Crop kLaserRange{2.5F, 80.0F};
constexpr Crop kCameraRange{0.3F, 6.0F};

PairSet
laserSet()
{
  return {};
}

PairSet
cameraSet()
{
  return {{}, 0.02, 0.02, 0.03, 0.02, 0.015};
}

PairSet
simulated(const LaserModel& laser)
{
  const SimulatedDrive drive(makeCircuit(), laser);
  const Choice choice{{10, 12}, {150, 152}, {290, 292}, {430, 432}}; // 1.6 m apart
  return fill(laserSet(), drive, choice, kLaserRange);
}

PairSet
kitti(const std::string& scans, const std::string& poses, const Choice& choice)
{
  const auto root = test::dataRoot() / "kitti_odometry";
  if (!std::filesystem::exists(root))
    return {};
  ScanReadOptions options;
  options.correct_vertical_angles = true;
  options.poses_path = (root / "poses" / poses).string();
  return fill(laserSet(),
              *openKittiOdometry(root.string(), scans, options),
              choice,
              kLaserRange);
}

PairSet
camera(const std::string& name,
       const PinholeIntrinsics& intrinsics,
       const Choice& choice)
{
  const auto folder = test::dataRoot() / name;
  if (!std::filesystem::exists(folder))
    return {};
  ScanReadOptions options;
  options.cloud.intrinsics = intrinsics;
  return fill(
      cameraSet(), *openDepthSequence(folder.string(), options), choice, kCameraRange);
}

const std::map<std::string, std::function<PairSet()>>&
makers()
{
  static const std::map<std::string, std::function<PairSet()>> all{
      {"simulated_hdl64", [] { return simulated(LaserModel::hdl64()); }},
      {"simulated_vlp16", [] { return simulated(LaserModel::vlp16()); }},
      {"kitti_07",
       [] {
         return kitti("07", "07.txt", {{0, 1}, {1, 2}, {0, 2}});
       }},
      {"kitti_01",
       [] {
         return kitti("01_thin3", "01.txt", {{5, 6}, {15, 16}, {25, 26}});
       }},
      {"tum_desk",
       [] {
         return camera(
             "tum_fr1_desk", {517.3, 516.5, 318.6, 255.3}, {{0, 2}, {3, 5}, {6, 8}});
       }},
      {"seven_scenes",
       [] {
         return camera("seven_scenes_redkitchen",
                       {585.0, 585.0, 320.0, 240.0},
                       {{0, 2}, {50, 52}, {100, 102}});
       }},
      {"redwood", [] {
         return camera("redwood_livingroom",
                       {525.0, 525.0, 319.5, 239.5},
                       {{0, 2}, {1, 3}, {2, 4}});
       }}};
  return all;
}

} // namespace

const std::vector<std::string>&
pairSetNames()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& maker : makers())
      all.push_back(maker.first);
    return all;
  }();
  return names;
}

PairSet
pairSet(const std::string& name)
{
  return makers().at(name)();
}

} // namespace bench
} // namespace nurbs
} // namespace pcl
