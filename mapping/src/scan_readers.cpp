// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/kitti_calibration.h>

#include "kitti_files.h"

namespace pcl {
namespace nurbs {
namespace {

using std::filesystem::path;

/** The path an option names, or the first of the layout's own that exists. */
path
chosen(const std::string& option, const std::vector<path>& candidates)
{
  return option.empty() ? firstThatExists(candidates) : path(option);
}

void
addPointTimes(ScanFiles& files, const path& folder)
{
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    return;
  for (ScanFile& scan : files.scans)
    scan.point_times = folder / scan.cloud.filename();
}

} // namespace

std::unique_ptr<ScanSource>
openKittiOdometry(const std::string& root,
                  const std::string& sequence,
                  const ScanReadOptions& options)
{
  ScanFiles files(options);
  const path folder = path(root) / "sequences" / sequence;
  listNumbered(files, folder / "velodyne");
  addPointTimes(files, folder / "point_times");
  addTimes(files, chosen(options.times_path, {folder / "times.txt"}));
  const path poses =
      chosen(options.poses_path, {path(root) / "poses" / (sequence + ".txt")});
  const path calibration = folder / "calib.txt";
  std::error_code error;
  const bool calibrated =
      (std::filesystem::exists(calibration, error) || !poses.empty()) &&
      files.faults.attempt(
          [&] { files.calibration = readKittiCalibration(calibration.string()); });
  if (calibrated && !poses.empty())
    files.faults.attempt([&] {
      files.setTruth(inLaserFrame(readTrajectory(poses.string()), files.calibration),
                     poses);
    });
  return files.open();
}

std::unique_ptr<ScanSource>
openCloudFolder(const std::string& folder, const ScanReadOptions& options)
{
  ScanFiles files(options);
  files.folder = folder;
  for (const path& file : filesByName(folder, {".pcd", ".ply", ".bin"})) {
    ScanFile scan;
    scan.cloud = file;
    scan.line = files.scans.size();
    scan.stamp = static_cast<double>(scan.line) * options.period;
    files.scans.push_back(scan);
  }
  const path above = path(folder) / "..";
  addTimes(
      files,
      chosen(options.times_path, {path(folder) / "times.txt", above / "times.txt"}));
  const path poses =
      chosen(options.poses_path, {path(folder) / "poses.txt", above / "poses.txt"});
  if (!poses.empty())
    files.faults.attempt(
        [&] { files.setTruth(readTrajectory(poses.string()), poses); });
  return files.open();
}

} // namespace nurbs
} // namespace pcl
