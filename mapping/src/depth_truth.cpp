// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "depth_layouts.h"
#include "pose_interpolation.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace pcl {
namespace nurbs {
namespace {

using std::filesystem::path;

constexpr double kFarthestPose = 0.1; // seconds

/** Row by row, as the words from \a first on say. \throws InputError */
Eigen::Isometry3d
rigidMotion(const path& file, const std::vector<double>& rows)
{
  constexpr double kMostOff = 1e-3;
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> matrix(
      rows.data());
  const Eigen::Matrix3d rotation = matrix.leftCols<3>();
  if (!(rotation * rotation.transpose()).isIdentity(kMostOff) ||
      rotation.determinant() < 0.0)
    throw InputError(file.string(), "a rotation is not orthonormal");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation;
  pose.translation() = matrix.col(3);
  return pose;
}

/** A matrix of 4 x 4 by rows. */
Eigen::Isometry3d
readMatrix(const path& file,
           const std::vector<std::vector<std::string>>& lines,
           std::size_t first)
{
  std::vector<double> numbers;
  for (std::size_t row = first; row < std::min(first + 4, lines.size()); ++row)
    for (const std::string& word : lines[row])
      numbers.push_back(numberOf(file, word));
  if (numbers.size() != 16)
    throw InputError(file.string(), "a pose is not a matrix of 4 x 4 numbers");
  return rigidMotion(file, numbers);
}

/** The pose at a time between two that are near; nothing otherwise. */
std::optional<Eigen::Isometry3d>
nearPose(const Trajectory& poses, double time)
{
  const auto after = std::lower_bound(
      poses.begin(), poses.end(), time, [](const StampedPose& pose, double t) {
        return pose.stamp < t;
      });
  if (after != poses.end() && after->stamp == time)
    return after->T_world_body;
  if (after == poses.begin() || after == poses.end())
    return std::nullopt;
  const StampedPose& before = *(after - 1);
  if (after->stamp - time > kFarthestPose || time - before.stamp > kFarthestPose)
    return std::nullopt;
  return interpolatePose(before, *after, time);
}

void
addByTime(ScanFiles& files, const path& file)
{
  const Trajectory poses = readTrajectory(file.string());
  for (ScanFile& scan : files.scans)
    scan.truth = nearPose(poses, scan.stamp);
}

/** Redwood's .log: "i i n" and a matrix for each pose. */
void
addByLog(ScanFiles& files, const path& file)
{
  const auto lines = wordsOf(file);
  Trajectory poses;
  for (std::size_t k = 0; k < lines.size(); k += 5)
    poses.push_back({0.0, readMatrix(file, lines, k + 1)});
  files.setTruth(poses, file);
}

/** frame-N.pose.txt beside each image; some have none. */
void
addByImage(ScanFiles& files)
{
  std::error_code error;
  for (ScanFile& scan : files.scans) {
    const path file = poseFileOf(scan.cloud);
    if (!file.empty() && std::filesystem::exists(file, error))
      files.faults.attempt([&] { scan.truth = readMatrix(file, wordsOf(file), 0); });
  }
}

/** The matrix of an Open3D camera, by columns. */
std::vector<double>
readCameraJson(const path& file)
{
  std::ifstream stream(file);
  const nlohmann::json camera = nlohmann::json::parse(stream, nullptr, false);
  if (!camera.is_object() || !camera.contains("intrinsic_matrix"))
    return {};
  const nlohmann::json& matrix = camera["intrinsic_matrix"];
  const bool numbers =
      matrix.is_array() && std::all_of(matrix.begin(), matrix.end(), [](const auto& n) {
        return n.is_number();
      });
  if (!numbers || matrix.size() != 9)
    return {};
  const auto n = matrix.get<std::vector<double>>();
  return {n[0], n[4], n[6], n[7]};
}

/** fx fy cx cy of a text file. */
std::vector<double>
readCameraText(const path& file)
{
  std::vector<double> n;
  for (const std::vector<std::string>& words : wordsOf(file))
    for (const std::string& word : words)
      n.push_back(numberOf(file, word));
  if (n.size() == 9)
    n = {n[0], n[4], n[2], n[5]};
  return n;
}

} // namespace

std::optional<PinholeIntrinsics>
readIntrinsics(const path& folder)
{
  std::error_code error;
  for (const char* name : {"intrinsics.txt",
                           "camera-intrinsics.txt",
                           "camera.json",
                           "camera_primesense.json",
                           "camera_intrinsic.json"}) {
    const path file = folder / name;
    if (!std::filesystem::exists(file, error))
      continue;
    const std::vector<double> n =
        file.extension() == ".json" ? readCameraJson(file) : readCameraText(file);
    if (n.size() != 4 || n[0] == 0.0 || n[1] == 0.0)
      throw InputError(file.string(), "holds neither fx fy cx cy nor a camera matrix");
    return PinholeIntrinsics{n[0], n[1], n[2], n[3]};
  }
  return std::nullopt;
}

void
addDepthTruth(ScanFiles& files, const path& poses)
{
  constexpr std::size_t kKittiColumns = 12;
  if (poses.extension() == ".log")
    return addByLog(files, poses);
  const auto lines = wordsOf(poses);
  if (!lines.empty() && lines.front().size() == kKittiColumns)
    files.setTruth(readTrajectory(poses.string()), poses);
  else
    addByTime(files, poses);
  const bool none = std::none_of(files.scans.begin(),
                                 files.scans.end(),
                                 [](const ScanFile& scan) { return scan.truth; });
  if (none)
    throw InputError(poses.string(), "has no pose at the time of any scan");
}

void
addDepthTruthOfLayout(ScanFiles& files, const path& folder)
{
  std::error_code error;
  for (const char* name : {"groundtruth.txt", "trajectory.log"})
    if (std::filesystem::exists(folder / name, error))
      return addDepthTruth(files, folder / name);
  addByImage(files);
}

} // namespace nurbs
} // namespace pcl
