// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/simulator/drive_writer.h>

#include <pcl/surface/nurbs/atomic_file.h>

#include "depth_png_writer.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

using std::filesystem::path;

void
makeFolder(const path& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error("cannot write " + folder.string() + ": " +
                             error.message());
}

template <typename... Values>
std::string
formatted(const char* format, Values... values)
{
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

template <typename Value>
void
writeNumbers(const path& file, const std::vector<Value>& numbers)
{
  writeFileAtomically(
      file.string(),
      {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Value)});
}

/** Writes scan after scan, and what belongs to those written in any case. */
template <typename WriteScan, typename Finish>
std::size_t
writeScans(const SimulatedDrive& drive,
           const DriveWriteOptions& options,
           const WriteScan& writeScan,
           const Finish& finish)
{
  if (options.first >= drive.size())
    throw std::invalid_argument("the drive has no scan " +
                                std::to_string(options.first));
  const std::size_t left = drive.size() - options.first;
  const std::size_t count = options.count == 0 ? left : std::min(options.count, left);
  Trajectory written;
  try {
    for (std::size_t k = 0; k < count; ++k) {
      writeScan(k, drive.simulate(options.first + k));
      written.push_back((*drive.truth())[options.first + k]);
      if (options.progress && !options.progress(written.size()))
        break;
    }
  } catch (...) {
    finish(written);
    throw;
  }
  finish(written);
  return written.size();
}

void
writeKittiScan(const path& sequence,
               const std::string& name,
               const SimulatedDrive& drive,
               const SimulatedScan& simulated,
               bool labels)
{
  std::vector<float> points;
  std::vector<float> times;
  std::vector<std::uint32_t> surfaces;
  const Scan& scan = simulated.scan;
  for (std::size_t i = 0; i < scan.cloud->size(); ++i) {
    const std::uint32_t id = simulated.surfaces[i];
    if (id == BeamHit::kNothing)
      continue;
    const pcl::PointXYZI& point = (*scan.cloud)[i];
    points.insert(points.end(), {point.x, point.y, point.z, point.intensity});
    if (!scan.point_times.empty())
      times.push_back(scan.point_times[i]);
    const TownSurface& surface = drive.town().surface(id);
    surfaces.push_back((static_cast<std::uint32_t>(surface.kind) + 1U) | surface.object
                                                                             << 16U);
  }
  writeNumbers(sequence / "velodyne" / (name + ".bin"), points);
  if (!scan.point_times.empty())
    writeNumbers(sequence / "point_times" / (name + ".bin"), times);
  if (labels)
    writeNumbers(sequence / "labels" / (name + ".label"), surfaces);
}

std::string
matrixLine(const char* name, const Eigen::Matrix<double, 3, 4>& m)
{
  std::string line = std::string(name) + ":";
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = 0; column < 4; ++column)
      line += formatted(" %.12e", m(row, column));
  return line + "\n";
}

void
writeKittiCalibration(const path& file, const Eigen::Isometry3d& T_camera_laser)
{
  Eigen::Matrix<double, 3, 4> camera;
  camera << 718.856, 0.0, 607.1928, 0.0, 0.0, 718.856, 185.2157, 0.0, 0.0, 0.0, 1.0,
      0.0;
  std::string text;
  for (const char* name : {"P0", "P1", "P2", "P3"})
    text += matrixLine(name, camera);
  text += matrixLine("Tr", T_camera_laser.matrix().topRows<3>());
  writeFileAtomically(file.string(), text);
}

std::vector<std::uint16_t>
depthPixels(const pcl::PointCloud<pcl::PointXYZI>& cloud, double scale)
{
  constexpr double kMost = 65534.0; // the largest number means no reading
  std::vector<std::uint16_t> pixels;
  pixels.reserve(cloud.size());
  for (const pcl::PointXYZI& point : cloud) {
    const double stored = std::round(point.z * scale);
    pixels.push_back(stored >= 1.0 && stored <= kMost
                         ? static_cast<std::uint16_t>(stored)
                         : std::uint16_t{0});
  }
  return pixels;
}

} // namespace

std::size_t
writeKittiDrive(const SimulatedDrive& drive,
                const std::string& folder,
                const DriveWriteOptions& options)
{
  if (!std::holds_alternative<LaserModel>(drive.sensor()))
    throw std::invalid_argument("writeKittiDrive: the sensor is not a laser");
  const path sequence = path(folder) / "sequences" / options.sequence;
  const path poses = path(folder) / "poses";
  makeFolder(poses);
  makeFolder(sequence / "velodyne");
  if (options.labels)
    makeFolder(sequence / "labels");
  if (!drive.read(options.first).point_times.empty())
    makeFolder(sequence / "point_times");
  writeKittiCalibration(sequence / "calib.txt", drive.calibration());
  return writeScans(
      drive,
      options,
      [&](std::size_t k, const SimulatedScan& scan) {
        writeKittiScan(sequence, formatted("%06zu", k), drive, scan, options.labels);
      },
      [&](Trajectory written) {
        std::string times;
        const Eigen::Isometry3d T = drive.calibration();
        for (StampedPose& pose : written) {
          times += formatted("%.9e\n", pose.stamp);
          pose.T_world_body = T * pose.T_world_body * T.inverse();
        }
        writeFileAtomically((sequence / "times.txt").string(), times);
        writeKittiTrajectory((poses / (options.sequence + ".txt")).string(), written);
      });
}

std::size_t
writeTumDrive(const SimulatedDrive& drive,
              const std::string& folder,
              const DriveWriteOptions& options)
{
  const auto* camera = std::get_if<DepthCameraModel>(&drive.sensor());
  if (camera == nullptr)
    throw std::invalid_argument("writeTumDrive: the sensor is not a depth camera");
  constexpr double kScale = 5000.0;
  const path root(folder);
  makeFolder(root / "depth");
  const PinholeIntrinsics& lens = camera->intrinsics;
  writeFileAtomically(
      (root / "intrinsics.txt").string(),
      formatted(
          "# fx fy cx cy\n%.9f %.9f %.9f %.9f\n", lens.fx, lens.fy, lens.cx, lens.cy));
  const auto name = [](double stamp) { return formatted("depth/%.6f.png", stamp); };
  return writeScans(
      drive,
      options,
      [&](std::size_t, const SimulatedScan& scan) {
        writeDepthPng((root / name(scan.scan.stamp)).string(),
                      depthPixels(*scan.scan.cloud, kScale),
                      scan.scan.cloud->width);
      },
      [&](const Trajectory& written) {
        std::string list = "# timestamp filename\n";
        for (const StampedPose& pose : written)
          list +=
              formatted("%.9f %s\n", pose.stamp, name(pose.stamp).c_str()); // as poses
        writeFileAtomically((root / "depth.txt").string(), list);
        writeTumTrajectory((root / "groundtruth.txt").string(), written);
      });
}

} // namespace nurbs
} // namespace pcl
