// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/kitti_calibration.h>

#include "kitti_files.h"
#include "oxts_poses.h"

namespace pcl {
namespace nurbs {
namespace {

using std::filesystem::path;

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

/** A file of the drive's calibration: in the drive or in the folder of its day. */
path
calibrationFile(const std::string& drive, const char* name)
{
  return firstThatExists({path(drive) / name, path(drive) / ".." / name});
}

/** Poses of the laser by the vehicle's navigation, in the frame of the first one. */
void
addNavigation(ScanFiles& files, const path& folder, const path& calibration)
{
  // The same numbers of the same form: R and T.
  const Eigen::Isometry3d T_laser_imu = readKittiCalibration(calibration.string());
  std::optional<Eigen::Isometry3d> T_first_map;
  double scale_latitude = 0.0;
  for (ScanFile& scan : files.scans) {
    const path record_file =
        folder / path(scan.cloud.filename()).replace_extension(".txt");
    files.faults.attempt([&] {
      const OxtsRecord record = readOxts(record_file);
      if (!T_first_map)
        scale_latitude = record.latitude;
      const Eigen::Isometry3d T_map_laser =
          poseOnMap(record, scale_latitude) * T_laser_imu.inverse();
      if (!T_first_map)
        T_first_map = T_map_laser.inverse();
      scan.truth = *T_first_map * T_map_laser;
    });
  }
}

} // namespace

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
  const path calibration = calibrationFile(drive, "calib_velo_to_cam.txt");
  if (!calibration.empty())
    files.faults.attempt(
        [&] { files.calibration = readKittiCalibration(calibration.string()); });
  if (!options.poses_path.empty())
    files.faults.attempt([&] {
      files.setTruth(readTrajectory(options.poses_path), options.poses_path);
    });
  const path navigation = path(drive) / "oxts" / "data";
  const path mounting = calibrationFile(drive, "calib_imu_to_velo.txt");
  if (options.poses_path.empty() && !mounting.empty() &&
      !firstThatExists({navigation}).empty())
    files.faults.attempt([&] { addNavigation(files, navigation, mounting); });
  return files.open();
}

} // namespace nurbs
} // namespace pcl
