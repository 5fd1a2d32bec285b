// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "pose_search.h"

#include "chunked_sum.h"
#include "occupancy_grid.h"

#include <pcl/registration/scan_preprocessing.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** Points that are looked at, at most. */
constexpr std::size_t kMostPoints = 256;
/** Of the grid's half edge, as far as points are used. */
constexpr double kReach = 0.85;
/** Candidates of the lattice that are improved. */
constexpr std::size_t kImproved = 24;

struct Candidate {
  Eigen::Isometry3d pose;
  int fit;

  EIGEN_MAKE_ALIGNED_OPERATOR_NEW
};

using Candidates = std::vector<Candidate, Eigen::aligned_allocator<Candidate>>;

/** Evenly spread points, none too far away. */
ScanPoints
sparsePoints(const ScanPoints& scan, double cell_size)
{
  const double reach = kReach * 0.5 * OccupancyGrid::kEdge * cell_size;
  ScanPoints near;
  for (const Eigen::Vector3f& point : voxelSubsample(scan, cell_size))
    if (point.norm() < reach)
      near.push_back(point);
  const std::size_t step = near.size() / kMostPoints + 1;
  ScanPoints kept;
  for (std::size_t i = 0; i < near.size(); i += step)
    kept.push_back(near[i]);
  return kept;
}

/** Rotation vectors of a body-centred lattice within a ball, the centre first. */
std::vector<Eigen::Vector3d>
rotationLattice(double max_angle, double step)
{
  std::vector<Eigen::Vector3d> vectors;
  const int n = static_cast<int>(std::ceil(max_angle / step));
  for (int x = -n; x <= n; ++x)
    for (int y = -n; y <= n; ++y)
      for (int z = -n; z <= n; ++z)
        for (const double half : {0.0, 0.5}) {
          const Eigen::Vector3d v = step * Eigen::Vector3d(x + half, y + half, z + half);
          if (v.norm() <= max_angle)
            vectors.push_back(v);
        }
  return vectors;
}

Poses
latticePoses(const Poses& starts, const PoseSearchRange& range, double cell_size)
{
  Poses poses = starts;
  for (const Eigen::Vector3d& turn : rotationLattice(range.max_angle, range.angle_step))
    for (const Eigen::Isometry3d& start : starts)
      for (int x = -range.max_shift; x <= range.max_shift; x += range.shift_step)
        for (int y = -range.max_shift; y <= range.max_shift; y += range.shift_step)
          for (int z = -range.max_shift; z <= range.max_shift; z += range.shift_step) {
            Tangent tangent = Tangent::Zero();
            tangent.tail<3>() = turn;
            Eigen::Isometry3d pose = starts.front() * exponential(tangent);
            pose.translation() =
                start.translation() + cell_size * Eigen::Vector3d(x, y, z);
            poses.push_back(pose);
          }
  return poses;
}

Candidates
fits(const OccupancyGrid& grid, const ScanPoints& scan, const Poses& poses, int threads)
{
  Candidates candidates(poses.size());
  const auto work = [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i)
      candidates[i] = {poses[i], grid.fit(scan, poses[i])};
  };
  forChunks(poses.size(), threads, work);
  return candidates;
}

void
sortByFit(Candidates& candidates)
{
  std::stable_sort(candidates.begin(),
                   candidates.end(),
                   [](const auto& a, const auto& b) { return a.fit > b.fit; });
}

/** Climb along the axes of the pose, in smaller and smaller steps. */
void
improve(const OccupancyGrid& grid,
        const ScanPoints& scan,
        double angle_step,
        Candidate& candidate)
{
  double part = 0.5;
  constexpr double kSmallest = 0.1;
  while (part > kSmallest) {
    Candidate best = candidate;
    for (int axis = 0; axis < 6; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        Tangent step = Tangent::Zero();
        step[axis] = sign * part * (axis < 3 ? grid.cellSize() : angle_step);
        const Eigen::Isometry3d pose = candidate.pose * exponential(step);
        const int fit = grid.fit(scan, pose);
        if (fit > best.fit)
          best = {pose, fit};
      }
    if (best.fit > candidate.fit)
      candidate = best;
    else
      part *= 0.5;
  }
}

bool
alike(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double way, double angle)
{
  const Eigen::Isometry3d between = a.inverse() * b;
  return between.translation().norm() < way &&
         Eigen::AngleAxisd(between.linear()).angle() < angle;
}

/** The first candidates that differ from those before them. */
Candidates
different(const Candidates& sorted, double way, double angle, std::size_t most)
{
  Candidates kept;
  for (const Candidate& candidate : sorted) {
    if (kept.size() == most)
      break;
    if (std::none_of(kept.begin(), kept.end(), [&](const Candidate& other) {
          return alike(candidate.pose, other.pose, way, angle);
        }))
      kept.push_back(candidate);
  }
  return kept;
}

} // namespace

Poses
searchPoses(const VoxelMap& map,
            const ScanPoints& scan,
            const Poses& starts,
            const PoseSearchRange& range,
            double cell_size,
            std::size_t most,
            int threads)
{
  const OccupancyGrid grid(map.points(), starts.front().translation(), cell_size);
  const ScanPoints points = sparsePoints(scan, cell_size);
  Candidates candidates =
      fits(grid, points, latticePoses(starts, range, cell_size), threads);
  sortByFit(candidates);
  candidates = different(candidates, cell_size, 0.8 * range.angle_step, kImproved);
  for (Candidate& candidate : candidates)
    improve(grid, points, range.angle_step, candidate);
  sortByFit(candidates);
  Poses poses;
  for (const Candidate& candidate :
       different(candidates, 0.7 * cell_size, 0.4 * range.angle_step, most))
    poses.push_back(candidate.pose);
  return poses;
}

} // namespace nurbs
} // namespace pcl
