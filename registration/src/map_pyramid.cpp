// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/registration/map_pyramid.h>
#include <pcl/registration/scan_preprocessing.h>

#include "scan_alignment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Fewer voxels than this hold no pose. */
constexpr std::size_t kMinVoxels = 30;
/** A coarse alignment uses one point per voxel, and few iterations to a coarse end. */
constexpr int kCoarseIterations = 20;
constexpr double kCoarseStep = 0.02;
/** Pairs may be so many voxels apart. */
constexpr double kReach = 2.0;

MatchOptions
coarseOptions(MatchOptions options, double voxel_size)
{
  options.metric = MatchMetric::PointToPlane;
  options.max_distance = std::min(options.max_distance, kReach * voxel_size);
  options.max_iterations = std::min(options.max_iterations, kCoarseIterations);
  options.translation_epsilon =
      std::max(options.translation_epsilon, kCoarseStep * voxel_size);
  options.rotation_epsilon = std::max(options.rotation_epsilon, 1e-3);
  return options;
}

/** How well a scan lies on a map, 0 to 1: points count by Geman and McClure's weight of
 * their distance over a voxel. */
double
fitAt(const VoxelMap& map, const ScanPoints& scan, const Eigen::Isometry3d& pose)
{
  const double size = map.options().voxel_size;
  const RobustKernel kernel{RobustKernelType::GemanMcClure, size};
  double sum = 0.0;
  for (const Eigen::Vector3f& point : scan) {
    const Eigen::Vector3d place = pose * point.cast<double>();
    const auto nearest = map.nearest(place, kReach * size);
    sum += nearest ? kernel.weight((*nearest - place).squaredNorm()) : 0.0;
  }
  return sum / static_cast<double>(std::max<std::size_t>(scan.size(), 1));
}

/** Where to begin on a map: a coarse alignment that lost its way, as one with little
 * overlap may, is no better than the guess. */
Eigen::Isometry3d
betterStart(const VoxelMap& map,
            const ScanPoints& scan,
            const Eigen::Isometry3d& coarse,
            const Eigen::Isometry3d& guess)
{
  constexpr std::size_t kMostPoints = 1000;
  if (coarse.isApprox(guess, 0.0))
    return guess;
  const ScanPoints some = thinned(scan, kMostPoints);
  return fitAt(map, some, coarse) > fitAt(map, some, guess) ? coarse : guess;
}

} // namespace

MapPyramid::MapPyramid(VoxelMap fine, int coarser)
{
  if (coarser < 0)
    throw std::invalid_argument("MapPyramid: the number of maps must not be negative");
  maps_.push_back(std::move(fine));
  for (int i = 0; i < coarser; ++i) {
    VoxelMap next = maps_.back().coarsened();
    if (next.voxelCount() < kMinVoxels)
      return;
    maps_.push_back(std::move(next));
  }
}

MatchResult
MapPyramid::match(const ScanPoints& scan,
                  const ScanPoints& normals,
                  const Eigen::Isometry3d& guess,
                  const MatchOptions& options) const
{
  Eigen::Isometry3d start = guess;
  int iterations = 0;
  for (std::size_t level = maps_.size() - 1; level > 0; --level) {
    const VoxelMap& map = maps_[level];
    const double size = map.options().voxel_size;
    if (size > options.max_distance)
      continue;
    const ScanPoints some = voxelSubsample(scan, size);
    start = betterStart(map, some, start, guess);
    const MatchResult coarse =
        matchScan(map, some, {}, start, coarseOptions(options, size));
    iterations += coarse.iterations;
    if (coarse.correspondences > 0)
      start = coarse.pose;
  }
  MatchOptions fine_options = options;
  fine_options.max_distance =
      std::min(options.max_distance, kReach * fine().options().voxel_size);
  MatchResult result = matchScan(fine(), scan, normals, start, fine_options);
  if (result.inlier_share < kSureShare && !start.isApprox(guess, 0.0)) {
    MatchResult other = matchScan(fine(), scan, normals, guess, fine_options);
    if (other.fit() > result.fit())
      result = std::move(other);
  }
  result.iterations += iterations;
  return result;
}

} // namespace nurbs
} // namespace pcl
