// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "scan_files.h"

#include <pcl/registration/scan_preprocessing.h>

#include "input_file.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kLargestTimes = std::size_t{1} << 30U;

void
turnUpwards(pcl::PointCloud<pcl::PointXYZI>& cloud)
{
  const VerticalTurn turn(kKittiVerticalAngle);
  for (pcl::PointXYZI& point : cloud)
    point.getVector3fMap() = turn(point.getVector3fMap());
}

std::vector<float>
readPointTimes(const std::filesystem::path& path, std::size_t points)
{
  const InputFile file = loadInputFile(path.string(), kLargestTimes);
  if (file.bytes.size() != points * sizeof(float))
    file.fail("does not hold a time for each of " + std::to_string(points) + " points");
  std::vector<float> times(points);
  std::memcpy(times.data(), file.bytes.data(), file.bytes.size());
  return times;
}

/** Scans that lie in files, read when they are asked for. */
class FileScanSource : public ScanSource {
public:
  explicit FileScanSource(ScanFiles files) : files_(std::move(files))
  {
    for (const ScanFile& scan : files_.scans)
      if (scan.truth)
        truth_.push_back({scan.stamp, *scan.truth});
  }

  std::size_t
  size() const override
  {
    return files_.scans.size();
  }

  double
  stamp(std::size_t index) const override
  {
    return scan(index).stamp;
  }

  Scan
  read(std::size_t index) const override
  {
    const ScanFile& file = scan(index);
    const InputCloud input = readCloud(file.cloud.string(), files_.options.cloud);
    Scan result;
    result.stamp = file.stamp;
    result.cloud = withIntensity(input);
    if (files_.options.correct_vertical_angles)
      turnUpwards(*result.cloud);
    if (!file.point_times.empty())
      result.point_times = readPointTimes(file.point_times, result.cloud->size());
    if (input.intrinsics)
      result.geometry = GridGeometry::pinhole(static_cast<int>(input.cloud->width),
                                              static_cast<int>(input.cloud->height),
                                              *input.intrinsics);
    return result;
  }

  const Trajectory*
  truth() const override
  {
    return truth_.empty() ? nullptr : &truth_;
  }

  Eigen::Isometry3d
  calibration() const override
  {
    return files_.calibration;
  }

  const std::vector<std::string>&
  problems() const override
  {
    return files_.faults.lines();
  }

private:
  const ScanFile&
  scan(std::size_t index) const
  {
    if (index >= files_.scans.size())
      throw std::invalid_argument("ScanSource: there is no scan " +
                                  std::to_string(index));
    return files_.scans[index];
  }

  static pcl::PointCloud<pcl::PointXYZI>::Ptr
  withIntensity(const InputCloud& input)
  {
    auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZI>>(input.cloud->width,
                                                                   input.cloud->height);
    for (std::size_t i = 0; i < cloud->size(); ++i) {
      // What was taken off large coordinates belongs to the sensor's frame.
      (*cloud)[i].getVector3fMap() =
          ((*input.cloud)[i].getVector3fMap().cast<double>() + input.offset)
              .cast<float>();
      (*cloud)[i].intensity = input.intensity.empty() ? 0.0F : input.intensity[i];
    }
    cloud->is_dense = input.cloud->is_dense;
    return cloud;
  }

  ScanFiles files_;
  Trajectory truth_;
};

/** Whether a file is there and looks like its extension says. */
void
requireWhole(const ScanFile& scan, const CloudReadOptions& options)
{
  const std::string name = scan.cloud.string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(scan.cloud, error))
    throw InputError(name, "does not exist");
  const auto size = std::filesystem::file_size(scan.cloud, error);
  if (error || size == 0)
    throw InputError(name, error ? error.message() : "is empty");
  const auto stride = static_cast<std::uintmax_t>(4 * options.bin_values_per_point);
  if (scan.cloud.extension() == ".bin" && size % stride != 0)
    throw InputError(name,
                     "its size of " + std::to_string(size) +
                         " bytes is not a multiple of " + std::to_string(stride));
  std::string start(4, '\0');
  std::ifstream(name, std::ios::binary).read(start.data(), 4);
  const auto extension = scan.cloud.extension();
  const bool png = start == "\x89PNG";
  const bool ply = start.substr(0, 3) == "ply";
  if (png != (extension == ".png") || ply != (extension == ".ply"))
    throw InputError(name, "its content is not what its extension says");
}

} // namespace

void
FaultList::report(const std::filesystem::path& file, const std::string& reason)
{
  attempt([&] { throw InputError(file.string(), reason); });
}

ScanFiles::ScanFiles(const ScanReadOptions& read_options)
    : options(read_options), faults(read_options.skip_faults)
{
  if (!(options.period > 0.0) || !std::isfinite(options.period))
    throw std::invalid_argument("ScanReadOptions: the period must be positive");
  if (!(options.cloud.depth_scale >= 0.0))
    throw std::invalid_argument("ScanReadOptions: the depth scale must be positive");
  if (options.cloud.bin_values_per_point != 3 &&
      options.cloud.bin_values_per_point != 4)
    throw std::invalid_argument("ScanReadOptions: .bin has 3 or 4 values per point");
}

void
ScanFiles::keepOnly(const std::vector<bool>& good)
{
  std::size_t kept = 0;
  for (std::size_t k = 0; k < scans.size(); ++k)
    if (good[k])
      scans[kept++] = scans[k];
  scans.resize(kept);
}

void
ScanFiles::setStamps(const std::vector<double>& times,
                     const std::filesystem::path& source)
{
  std::vector<bool> good;
  for (ScanFile& scan : scans) {
    good.push_back(scan.line < times.size());
    if (good.back())
      scan.stamp = times[scan.line];
    else
      faults.report(source, "has no time for " + scan.cloud.filename().string());
  }
  keepOnly(good);
}

void
ScanFiles::setTruth(const Trajectory& poses, const std::filesystem::path& source)
{
  std::size_t with = 0;
  for (ScanFile& scan : scans)
    if (scan.line < poses.size()) {
      scan.truth = poses[scan.line].T_world_body;
      ++with;
    }
  if (with < scans.size())
    faults.report(source,
                  "has a pose for " + std::to_string(with) + " of " +
                      std::to_string(scans.size()) + " scans");
}

std::unique_ptr<ScanSource>
ScanFiles::open()
{
  if (!(options.cloud.depth_scale > 0.0))
    options.cloud.depth_scale = CloudReadOptions().depth_scale;
  std::vector<bool> good;
  double last = -std::numeric_limits<double>::infinity();
  for (const ScanFile& scan : scans) {
    const bool ordered = scan.stamp >= last;
    if (!ordered)
      faults.report(scan.cloud, "its time runs backwards");
    good.push_back(ordered &&
                   faults.attempt([&] { requireWhole(scan, options.cloud); }));
    if (good.back())
      last = scan.stamp;
  }
  keepOnly(good);
  if (scans.empty())
    throw InputError(folder.string(), "has no scan that can be read");
  return std::make_unique<FileScanSource>(std::move(*this));
}

} // namespace nurbs
} // namespace pcl
