// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "depth_layouts.h"

#include <algorithm>

namespace pcl {
namespace nurbs {
namespace {

using std::filesystem::path;

constexpr const char* kDepthEnding = ".depth.png";

bool
endsWith(const std::string& text, const std::string& ending)
{
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

/** A line of "stamp file" or "stamp file stamp file": where the depth image is told. */
std::size_t
depthColumn(const std::vector<std::string>& words)
{
  const auto isDepth = [&](std::size_t k) {
    return words[k].find("depth") != std::string::npos;
  };
  return words.size() == 4 && !(isDepth(1) && !isDepth(3)) ? 3 : 1;
}

void
listByFile(ScanFiles& files, const path& folder, const path& list, std::size_t columns)
{
  for (const std::vector<std::string>& words : wordsOf(list)) {
    if (words.size() != columns) {
      files.faults.report(list,
                          "\"" + words[0].substr(0, 20) + " ...\" has " +
                              std::to_string(words.size()) + " words, not " +
                              std::to_string(columns));
      continue;
    }
    const std::size_t column = depthColumn(words);
    ScanFile scan;
    scan.cloud = folder / words[column];
    scan.line = files.scans.size();
    if (files.faults.attempt([&] { scan.stamp = numberOf(list, words[column - 1]); }))
      files.scans.push_back(scan);
  }
}

/** The images of a folder that has no list: those of Microsoft's names or, in depth/,
 * all. */
std::vector<path>
imagesByName(const path& folder)
{
  std::error_code error;
  for (const path& place : {folder / "depth", folder / "frames", folder}) {
    if (!std::filesystem::is_directory(place, error))
      continue;
    std::vector<path> images = filesIn(place, {".png"});
    if (place != folder / "depth")
      images.erase(std::remove_if(images.begin(),
                                  images.end(),
                                  [](const path& image) {
                                    return !endsWith(image.string(), kDepthEnding);
                                  }),
                   images.end());
    if (!images.empty())
      return images;
  }
  return {};
}

/** By length of the name and then by name, so that 2.png comes before 10.png. */
bool
numberedBefore(const path& a, const path& b)
{
  const std::string first = a.filename().string();
  const std::string second = b.filename().string();
  return first.size() != second.size() ? first.size() < second.size() : first < second;
}

} // namespace

path
poseFileOf(const path& image)
{
  const std::string name = image.string();
  if (!endsWith(name, kDepthEnding))
    return {};
  return name.substr(0, name.size() - std::string(kDepthEnding).size()) + ".pose.txt";
}

void
listImages(ScanFiles& files, const path& folder)
{
  std::error_code error;
  const path list = folder / "depth.txt";
  const path associations = folder / "associations.txt";
  if (std::filesystem::exists(list, error))
    return listByFile(files, folder, list, 2);
  if (std::filesystem::exists(associations, error))
    return listByFile(files, folder, associations, 4);
  std::vector<path> images = imagesByName(folder);
  if (images.empty())
    throw InputError(folder.string(),
                     "holds no depth images (depth.txt, associations.txt, depth/*.png, "
                     "*.depth.png)");
  std::sort(images.begin(), images.end(), numberedBefore);
  for (const path& image : images) {
    ScanFile scan;
    scan.cloud = image;
    scan.line = files.scans.size();
    scan.stamp = static_cast<double>(scan.line) * files.options.period;
    files.scans.push_back(scan);
  }
}

double
depthScaleOf(const ScanFiles& files, const path& folder)
{
  constexpr double kTumScale = 5000.0;
  constexpr double kMillimetres = 1000.0;
  std::error_code error;
  const bool microsoft = !files.scans.empty() &&
                         endsWith(files.scans.front().cloud.string(), kDepthEnding);
  const bool redwood = std::filesystem::exists(folder / "trajectory.log", error);
  return microsoft || redwood ? kMillimetres : kTumScale;
}

bool
isDepthFolder(const std::string& folder)
{
  std::error_code error;
  const path place = folder;
  return std::filesystem::exists(place / "depth.txt", error) ||
         std::filesystem::exists(place / "associations.txt", error) ||
         !imagesByName(place).empty();
}

std::unique_ptr<ScanSource>
openDepthSequence(const std::string& folder, const ScanReadOptions& options)
{
  ScanFiles files(options);
  files.folder = folder;
  listImages(files, folder);
  if (!options.cloud.intrinsics)
    files.options.cloud.intrinsics = readIntrinsics(folder);
  if (options.cloud.depth_scale == 0.0)
    files.options.cloud.depth_scale = depthScaleOf(files, folder);
  if (!options.times_path.empty())
    files.setStamps(readTimes(options.times_path), options.times_path);
  files.faults.attempt([&] {
    if (options.poses_path.empty())
      addDepthTruthOfLayout(files, folder);
    else
      addDepthTruth(files, options.poses_path);
  });
  return files.open();
}

} // namespace nurbs
} // namespace pcl
