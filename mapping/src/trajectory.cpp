// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/trajectory.h>
#include <pcl/surface/nurbs/atomic_file.h>

#include "input_file.h"
#include "pose_interpolation.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kLargestFile = std::size_t{1} << 30U;
constexpr std::size_t kKittiColumns = 12;
constexpr std::size_t kTumColumns = 8;

/** Lines of numbers of a text file; comments and empty lines are skipped. */
class NumberLines {
public:
  explicit NumberLines(const std::string& path)
      : file_(loadInputFile(path, kLargestFile))
  {
  }

  /** The next line's numbers; false at the end of the file. */
  bool
  next(std::vector<double>& numbers)
  {
    numbers.clear();
    while (numbers.empty() && position_ < file_.bytes.size()) {
      const std::size_t end =
          std::min(file_.bytes.find('\n', position_), file_.bytes.size());
      const std::string_view line =
          std::string_view(file_.bytes).substr(position_, end - position_);
      position_ = end + 1;
      ++line_;
      parse(line, numbers);
    }
    return !numbers.empty();
  }

  [[noreturn]] void
  fail(const std::string& reason) const
  {
    file_.fail("line " + std::to_string(line_) + ": " + reason);
  }

  [[noreturn]] void
  failAsWhole(const std::string& reason) const
  {
    file_.fail(reason);
  }

private:
  void
  parse(std::string_view line, std::vector<double>& numbers) const
  {
    const char* const blanks = " \t\r,";
    for (std::size_t at = line.find_first_not_of(blanks);
         at != std::string_view::npos && line[at] != '#';
         at = line.find_first_not_of(blanks, at)) {
      const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
      const std::string_view word = line.substr(at, end - at);
      double value = 0.0;
      const char* const first = word.data() + (word.front() == '+' ? 1 : 0);
      const auto [last, error] =
          std::from_chars(first, word.data() + word.size(), value);
      if (error != std::errc() || last != word.data() + word.size() ||
          !std::isfinite(value))
        fail(quotedWord(word) + " is not a finite number");
      numbers.push_back(value);
      at = end;
    }
  }

  InputFile file_;
  std::size_t position_ = 0;
  std::size_t line_ = 0;
};

void
requireRotation(const Eigen::Matrix3d& matrix, const NumberLines& lines)
{
  constexpr double kMostOff = 1e-3;
  if (!(matrix * matrix.transpose()).isIdentity(kMostOff) || matrix.determinant() < 0.0)
    lines.fail("the rotation is not orthonormal");
}

StampedPose
poseOfKitti(const std::vector<double>& n, const NumberLines& lines)
{
  Eigen::Matrix<double, 3, 4> matrix;
  for (std::size_t k = 0; k < kKittiColumns; ++k)
    matrix(static_cast<Eigen::Index>(k / 4), static_cast<Eigen::Index>(k % 4)) = n[k];
  requireRotation(matrix.leftCols<3>(), lines);
  StampedPose pose;
  pose.T_world_body.linear() = matrix.leftCols<3>();
  pose.T_world_body.translation() = matrix.col(3);
  return pose;
}

StampedPose
poseOfTum(const std::vector<double>& n, const NumberLines& lines)
{
  constexpr double kMostOff = 1e-3;
  const Eigen::Quaterniond rotation(n[7], n[4], n[5], n[6]);
  if (!(std::abs(rotation.norm() - 1.0) <= kMostOff))
    lines.fail("the quaternion is not of unit length");
  StampedPose pose;
  pose.stamp = n[0];
  pose.T_world_body.linear() = rotation.normalized().toRotationMatrix();
  pose.T_world_body.translation() = Eigen::Vector3d(n[1], n[2], n[3]);
  return pose;
}

void
readStamps(const std::string& path, Trajectory& trajectory)
{
  NumberLines lines(path);
  std::vector<double> numbers;
  std::size_t count = 0;
  for (; lines.next(numbers); ++count) {
    if (numbers.size() != 1)
      lines.fail("has " + std::to_string(numbers.size()) + " numbers, not one time");
    if (count < trajectory.size())
      trajectory[count].stamp = numbers[0];
    if (count > 0 && count < trajectory.size() &&
        trajectory[count].stamp < trajectory[count - 1].stamp)
      lines.fail("time runs backwards");
  }
  if (count != trajectory.size())
    lines.failAsWhole("has " + std::to_string(count) + " times for " +
                      std::to_string(trajectory.size()) + " poses");
}

/** Formats each pose into a line; one call of \a format writes at most 511 bytes. */
template <typename Format>
void
writeLines(const std::string& path, const Trajectory& trajectory, const Format& format)
{
  AtomicFile file(path);
  std::array<char, 512> line{};
  for (const StampedPose& pose : trajectory) {
    const int length = format(line.data(), line.size(), pose);
    file.write(line.data(), static_cast<std::size_t>(length));
  }
  file.commit();
}

} // namespace

Trajectory
readTrajectory(const std::string& path, const std::string& times_path)
{
  NumberLines lines(path);
  Trajectory result;
  std::size_t columns = 0;
  for (std::vector<double> numbers; lines.next(numbers);) {
    if (columns == 0)
      columns = numbers.size();
    if (numbers.size() != columns ||
        (columns != kKittiColumns && columns != kTumColumns))
      lines.fail("has " + std::to_string(numbers.size()) +
                 " numbers; a pose has 12 (KITTI) or 8 (TUM), all lines the same");
    StampedPose pose = columns == kKittiColumns ? poseOfKitti(numbers, lines)
                                                : poseOfTum(numbers, lines);
    if (columns == kKittiColumns)
      pose.stamp = static_cast<double>(result.size());
    if (!result.empty() && pose.stamp < result.back().stamp)
      lines.fail("time runs backwards");
    result.push_back(pose);
  }
  if (result.empty())
    lines.failAsWhole("has no pose");
  if (!times_path.empty()) {
    if (columns != kKittiColumns)
      lines.failAsWhole("has its own times; a file of times is for KITTI's format");
    readStamps(times_path, result);
  }
  return result;
}

void
writeKittiTrajectory(const std::string& path, const Trajectory& trajectory)
{
  writeLines(
      path, trajectory, [](char* line, std::size_t size, const StampedPose& pose) {
        const Eigen::Matrix<double, 3, 4> m = pose.T_world_body.matrix().topRows<3>();
        return std::snprintf(line,
                             size,
                             "%.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f "
                             "%.9f\n",
                             m(0, 0),
                             m(0, 1),
                             m(0, 2),
                             m(0, 3),
                             m(1, 0),
                             m(1, 1),
                             m(1, 2),
                             m(1, 3),
                             m(2, 0),
                             m(2, 1),
                             m(2, 2),
                             m(2, 3));
      });
}

void
writeTumTrajectory(const std::string& path, const Trajectory& trajectory)
{
  writeLines(
      path, trajectory, [](char* line, std::size_t size, const StampedPose& pose) {
        const Eigen::Vector3d t = pose.T_world_body.translation();
        const Eigen::Quaterniond q(pose.T_world_body.linear());
        return std::snprintf(line,
                             size,
                             "%.9f %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n",
                             pose.stamp,
                             t.x(),
                             t.y(),
                             t.z(),
                             q.x(),
                             q.y(),
                             q.z(),
                             q.w());
      });
}

StampedPose
poseAt(const Trajectory& trajectory, double time)
{
  if (trajectory.empty())
    throw std::invalid_argument("poseAt: the trajectory is empty");
  const auto after = std::lower_bound(
      trajectory.begin(),
      trajectory.end(),
      time,
      [](const StampedPose& pose, double moment) { return pose.stamp < moment; });
  if (after == trajectory.begin() || after == trajectory.end())
    return {time,
            after == trajectory.end() ? trajectory.back().T_world_body
                                      : after->T_world_body};
  if (after->stamp == time)
    return *after;
  return {time, interpolatePose(*(after - 1), *after, time)};
}

std::vector<double>
pathLengths(const Trajectory& trajectory)
{
  std::vector<double> result;
  result.reserve(trajectory.size());
  for (std::size_t k = 0; k < trajectory.size(); ++k)
    result.push_back(k == 0 ? 0.0
                            : result.back() +
                                  (trajectory[k].T_world_body.translation() -
                                   trajectory[k - 1].T_world_body.translation())
                                      .norm());
  return result;
}

} // namespace nurbs
} // namespace pcl
