// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/cloud_reader.h>

#include "cloud_formats.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>

namespace pcl {
namespace nurbs {
namespace {

CloudKind
kindByExtension(const InputFile& file)
{
  std::string extension = std::filesystem::path(file.name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  if (extension == ".pcd")
    return CloudKind::pcd;
  if (extension == ".ply")
    return CloudKind::ply;
  if (extension == ".bin")
    return CloudKind::kitti_bin;
  if (extension == ".png")
    return CloudKind::depth_png;
  file.fail("extension \"" + extension + "\" is none of .pcd, .ply, .bin and .png");
}

/** What the first bytes look like, where they tell. */
void
requireContent(const InputFile& file, CloudKind kind)
{
  const auto begins = [&](std::string_view mark) {
    return std::string_view(file.bytes).substr(0, mark.size()) == mark;
  };
  const bool pcd = begins("# .PCD") || begins("VERSION");
  const bool ply = begins("ply\n") || begins("ply\r");
  const bool png = begins("\x89PNG");
  const char* content = pcd ? "PCD" : ply ? "PLY" : png ? "PNG" : "";
  const bool agrees = (!pcd || kind == CloudKind::pcd) &&
                      (!ply || kind == CloudKind::ply) &&
                      (!png || kind == CloudKind::depth_png);
  if (!agrees)
    file.fail(std::string("its content is ") + content +
              ", which its extension does not say");
}

void
requireValid(const CloudReadOptions& options)
{
  if (options.bin_values_per_point != 3 && options.bin_values_per_point != 4)
    throw std::invalid_argument("readCloud: a .bin point has 3 or 4 values");
  if (!(options.depth_scale > 0.0) || !std::isfinite(options.depth_scale))
    throw std::invalid_argument("readCloud: the depth scale must be positive");
  const PinholeIntrinsics camera = options.intrinsics.value_or(PinholeIntrinsics());
  if (!std::isfinite(camera.fx * camera.fy * camera.cx * camera.cy) ||
      camera.fx == 0.0 || camera.fy == 0.0)
    throw std::invalid_argument("readCloud: the intrinsics make no camera");
}

/** The centre, to whole hundreds, of a cloud whose coordinates are so much larger than
 * its extent that single precision would be felt; zero for others. */
Eigen::Vector3d
largeOffset(const std::vector<Eigen::Vector3d>& points)
{
  constexpr double kLarge = 1e4;
  constexpr double kTimesExtent = 4.0;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector3d high = -low;
  for (const Eigen::Vector3d& point : points)
    if (point.allFinite()) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  const Eigen::Vector3d center = 0.5 * (low + high);
  const double extent = (high - low).maxCoeff();
  const double farthest = center.cwiseAbs().maxCoeff();
  if (!(farthest > kLarge) || !(farthest > kTimesExtent * extent))
    return Eigen::Vector3d::Zero();
  return (center / 100.0).array().round() * 100.0;
}

InputCloud
finish(RawCloud raw, CloudKind kind)
{
  InputCloud result;
  result.kind = kind;
  result.offset = largeOffset(raw.points);
  result.intensity = std::move(raw.intensity);
  result.rgb = std::move(raw.rgb);
  result.cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  result.cloud->reserve(raw.points.size());
  bool dense = true;
  for (const Eigen::Vector3d& point : raw.points) {
    const Eigen::Vector3f shifted = (point - result.offset).cast<float>();
    dense = dense && shifted.allFinite();
    result.cloud->emplace_back(shifted.x(), shifted.y(), shifted.z());
  }
  result.cloud->width = raw.width;
  result.cloud->height = raw.height;
  result.cloud->is_dense = dense;
  return result;
}

} // namespace

InputCloud
readCloud(const std::string& path, const CloudReadOptions& options)
{
  requireValid(options);
  const InputFile file = loadInputFile(path, options.max_file_size);
  const CloudKind kind = kindByExtension(file);
  requireContent(file, kind);
  PinholeIntrinsics intrinsics;
  switch (kind) {
  case CloudKind::pcd:
    return finish(readPcd(file), kind);
  case CloudKind::ply:
    return finish(readPly(file), kind);
  case CloudKind::kitti_bin:
    return finish(readBin(file, options.bin_values_per_point), kind);
  default:
    break;
  }
  InputCloud result = finish(readDepthPng(file, options, intrinsics), kind);
  result.intrinsics = intrinsics;
  return result;
}

} // namespace nurbs
} // namespace pcl
