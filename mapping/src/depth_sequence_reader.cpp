// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "pose_interpolation.h"
#include "scan_files.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

using std::filesystem::path;

constexpr double kTumScale = 5000.0;
constexpr double kFarthestPose = 0.1; // seconds

/** Stamps and files of depth.txt, or of the second half of associations.txt. */
void
listImages(ScanFiles& files, const path& folder)
{
  std::error_code error;
  const bool listed = std::filesystem::exists(folder / "depth.txt", error);
  const path list = folder / (listed ? "depth.txt" : "associations.txt");
  const std::size_t columns = listed ? 2 : 4;
  for (const std::vector<std::string>& words : wordsOf(list)) {
    if (words.size() != columns) {
      files.faults.report(list,
                          "\"" + words[0].substr(0, 20) + " ...\" has " +
                              std::to_string(words.size()) + " words, not " +
                              std::to_string(columns));
      continue;
    }
    ScanFile scan;
    scan.cloud = folder / words[columns - 1];
    scan.line = files.scans.size();
    if (files.faults.attempt([&] { scan.stamp = numberOf(list, words[columns - 2]); }))
      files.scans.push_back(scan);
  }
}

std::optional<PinholeIntrinsics>
readIntrinsics(const path& folder)
{
  std::error_code error;
  for (const char* name : {"intrinsics.txt", "camera-intrinsics.txt"}) {
    const path file = folder / name;
    if (!std::filesystem::exists(file, error))
      continue;
    std::vector<double> n;
    for (const std::vector<std::string>& words : wordsOf(file))
      for (const std::string& word : words)
        n.push_back(numberOf(file, word));
    if (n.size() == 9)
      n = {n[0], n[4], n[2], n[5]};
    if (n.size() != 4 || n[0] == 0.0 || n[1] == 0.0)
      throw InputError(file.string(), "holds neither fx fy cx cy nor a camera matrix");
    return PinholeIntrinsics{n[0], n[1], n[2], n[3]};
  }
  return std::nullopt;
}

/** The pose at a time between two that are near; nothing otherwise. */
std::optional<StampedPose>
poseAt(const Trajectory& poses, double time)
{
  const auto after = std::lower_bound(
      poses.begin(), poses.end(), time, [](const StampedPose& pose, double t) {
        return pose.stamp < t;
      });
  if (after != poses.end() && after->stamp == time)
    return *after;
  if (after == poses.begin() || after == poses.end())
    return std::nullopt;
  const StampedPose& before = *(after - 1);
  if (after->stamp - time > kFarthestPose || time - before.stamp > kFarthestPose)
    return std::nullopt;
  return StampedPose{time, interpolatePose(before, *after, time)};
}

/** Poses at the stamps of the scans; scans without one are faults. */
void
addTruth(ScanFiles& files, const path& file)
{
  const Trajectory poses = readTrajectory(file.string());
  Trajectory truth;
  std::vector<ScanFile> kept;
  for (const ScanFile& scan : files.scans) {
    const auto pose = poseAt(poses, scan.stamp);
    if (!pose) {
      files.faults.report(file, "has no pose for " + scan.cloud.filename().string());
      continue;
    }
    kept.push_back(scan);
    truth.push_back(*pose);
  }
  files.scans = std::move(kept);
  files.truth = std::move(truth);
}

} // namespace

std::unique_ptr<ScanSource>
openDepthSequence(const std::string& folder, const ScanReadOptions& options)
{
  ScanFiles files(options);
  files.folder = folder;
  listImages(files, folder);
  if (!options.cloud.intrinsics)
    files.options.cloud.intrinsics = readIntrinsics(folder);
  if (options.cloud.depth_scale == 0.0)
    files.options.cloud.depth_scale = kTumScale;
  const path poses = options.poses_path.empty() ? path(folder) / "groundtruth.txt"
                                                : path(options.poses_path);
  std::error_code error;
  if (!options.poses_path.empty() || std::filesystem::exists(poses, error))
    files.faults.attempt([&] { addTruth(files, poses); });
  return files.open();
}

} // namespace nurbs
} // namespace pcl
