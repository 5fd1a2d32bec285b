// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "kitti_files.h"

#include <charconv>

namespace pcl {
namespace nurbs {

using std::filesystem::path;

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

void
addTimes(ScanFiles& files, const path& times)
{
  std::vector<double> stamps;
  if (!times.empty() && files.faults.attempt([&] { stamps = readTimes(times); }))
    files.setStamps(stamps, times);
}

} // namespace nurbs
} // namespace pcl
