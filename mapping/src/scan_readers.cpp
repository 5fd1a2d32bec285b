// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/kitti_calibration.h>

#include "scan_files.h"

#include <charconv>

namespace pcl {
namespace nurbs {
namespace {

using std::filesystem::path;

/** Scans by the numbers that are their names; a missing one in between is a fault. */
void
listNumbered(ScanFiles& files, const path& folder)
{
  files.folder = folder;
  std::size_t next = 0;
  for (const path& file : filesByName(folder, {".bin"})) {
    const std::string name = file.stem().string();
    std::size_t number = 0;
    const char* const last = name.data() + name.size();
    const auto [end, error] = std::from_chars(name.data(), last, number);
    if (error != std::errc() || end != last || number < next) {
      files.faults.report(file, "its name is not the number of a scan");
      continue;
    }
    if (!files.scans.empty() && number > next)
      files.faults.report(file,
                          "scans " + std::to_string(next) + " to " +
                              std::to_string(number - 1) + " before it are missing");
    ScanFile scan;
    scan.cloud = file;
    scan.line = number;
    scan.stamp = static_cast<double>(number) * files.options.period;
    files.scans.push_back(scan);
    next = number + 1;
  }
}

path
firstThatExists(const std::vector<path>& candidates)
{
  std::error_code error;
  for (const path& candidate : candidates)
    if (!candidate.empty() && std::filesystem::exists(candidate, error))
      return candidate;
  return {};
}

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

void
addTimes(ScanFiles& files, const path& times)
{
  std::vector<double> stamps;
  if (!times.empty() && files.faults.attempt([&] { stamps = readTimes(times); }))
    files.setStamps(stamps, times);
}

/** Seconds of the day "DATE HH:MM:SS.fraction" after midnight. */
double
secondsOfDay(const path& file, const std::vector<std::string>& words)
{
  const std::string& clock = words.back();
  if (words.size() != 2 || clock.size() < 8 || clock[2] != ':' || clock[5] != ':')
    throw InputError(file.string(), "a line is not \"DATE HH:MM:SS.fraction\"");
  return 3600.0 * numberOf(file, clock.substr(0, 2)) +
         60.0 * numberOf(file, clock.substr(3, 2)) + numberOf(file, clock.substr(6));
}

std::vector<double>
readClockTimes(const path& file)
{
  constexpr double kDay = 86400.0;
  constexpr double kJump = 0.5 * kDay;
  std::vector<double> times;
  double first = 0.0;
  double midnights = 0.0;
  for (const std::vector<std::string>& words : wordsOf(file)) {
    double time = secondsOfDay(file, words) + midnights - first;
    if (times.empty()) {
      first = time;
      time = 0.0;
    }
    else if (time < times.back() - kJump) {
      midnights += kDay;
      time += kDay;
    }
    times.push_back(time);
  }
  return times;
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
openKittiRaw(const std::string& drive, const ScanReadOptions& options)
{
  ScanFiles files(options);
  const path folder = path(drive) / "velodyne_points";
  listNumbered(files, folder / "data");
  const path clock = folder / "timestamps.txt";
  if (!options.times_path.empty())
    addTimes(files, options.times_path);
  else if (!firstThatExists({clock}).empty()) {
    std::vector<double> times;
    if (files.faults.attempt([&] { times = readClockTimes(clock); }))
      files.setStamps(times, clock);
  }
  const path calibration =
      firstThatExists({path(drive) / "calib_velo_to_cam.txt",
                       path(drive) / ".." / "calib_velo_to_cam.txt"});
  if (!calibration.empty())
    files.faults.attempt(
        [&] { files.calibration = readKittiCalibration(calibration.string()); });
  if (!options.poses_path.empty())
    files.faults.attempt([&] {
      files.setTruth(readTrajectory(options.poses_path), options.poses_path);
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
