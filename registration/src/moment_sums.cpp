// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/registration/voxel_map.h>

namespace pcl {
namespace nurbs {
namespace {

/** Row and column of each element of a symmetric matrix's upper half. */
constexpr std::array<std::array<int, 2>, 6> kUpper{
    {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};

} // namespace

void
MomentSums::add(const Eigen::Vector3d& point)
{
  count += 1.0;
  first += point;
  for (std::size_t i = 0; i < kUpper.size(); ++i)
    second[i] += point[kUpper[i][0]] * point[kUpper[i][1]];
}

void
MomentSums::add(const MomentSums& other, const Eigen::Vector3d& shift)
{
  for (std::size_t i = 0; i < kUpper.size(); ++i) {
    const int r = kUpper[i][0];
    const int c = kUpper[i][1];
    second[i] += other.second[i] + shift[r] * other.first[c] +
                 other.first[r] * shift[c] + other.count * shift[r] * shift[c];
  }
  first += other.first + other.count * shift;
  count += other.count;
}

PointMoments
MomentSums::moments(const Eigen::Vector3d& origin) const
{
  if (count == 0.0)
    return {};
  PointMoments result;
  result.count = count;
  const Eigen::Vector3d local = first / count;
  result.mean = origin + local;
  for (std::size_t i = 0; i < kUpper.size(); ++i) {
    const int r = kUpper[i][0];
    const int c = kUpper[i][1];
    result.covariance(r, c) = result.covariance(c, r) =
        second[i] / count - local[r] * local[c];
  }
  return result;
}

} // namespace nurbs
} // namespace pcl
