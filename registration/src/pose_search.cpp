// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "pose_search.h"

#include "chunked_sum.h"
#include "shift_lattice.h"

#include <pcl/registration/scan_preprocessing.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** Points that are looked at, at most ... */
constexpr std::size_t kMostPoints = 256;
/** ... and first, to see which turns are worth a look at all of them: */
constexpr std::size_t kFirstPoints = 64;
/** the best so many. */
constexpr std::size_t kWorthwhile = 256;
/** Of the grid's half edge, as far as points are used. */
constexpr double kReach = 0.85;
/** Candidates of the lattice that are improved. */
constexpr std::size_t kImproved = 32;

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
  return thinned(near, kMostPoints);
}

/** Rotation vectors of a body-centred lattice within a ball. */
std::vector<Eigen::Vector3d>
rotationLattice(double max_angle, double step)
{
  std::vector<Eigen::Vector3d> vectors;
  const int n = static_cast<int>(std::ceil(max_angle / step));
  for (int x = -n; x <= n; ++x)
    for (int y = -n; y <= n; ++y)
      for (int z = -n; z <= n; ++z)
        for (const double half : {0.0, 0.5}) {
          const Eigen::Vector3d v =
              step * Eigen::Vector3d(x + half, y + half, z + half);
          if (v.norm() <= max_angle)
            vectors.push_back(v);
        }
  return vectors;
}

void
sortByFit(Candidates& candidates)
{
  std::stable_sort(candidates.begin(),
                   candidates.end(),
                   [](const auto& a, const auto& b) { return a.fit > b.fit; });
}

/** The first start, turned. */
Poses
turnedPoses(const Eigen::Isometry3d& start, const PoseSearchRange& range)
{
  Poses poses;
  for (const Eigen::Vector3d& vector :
       rotationLattice(range.max_angle, range.angle_step)) {
    Tangent turn = Tangent::Zero();
    turn.tail<3>() = vector;
    poses.push_back(start * exponential(turn));
  }
  return poses;
}

/** A pose with the shift from one of the places that suits it best. */
Candidate
bestShift(const OccupancyGrid& grid,
          const ShiftLattice& lattice,
          const ScanPoints& scan,
          const Poses& starts,
          const Eigen::Isometry3d& pose)
{
  Candidate best{pose, -1};
  for (const Eigen::Isometry3d& start : starts) {
    Eigen::Isometry3d there = pose;
    there.translation() = start.translation();
    const ShiftFit found = lattice.best(grid.placed(scan, there));
    if (found.fit <= best.fit)
      continue;
    there.translation() += grid.cellSize() * found.shift.cast<double>();
    best = {there, found.fit};
  }
  return best;
}

Candidates
shiftAll(const OccupancyGrid& grid,
         const ShiftLattice& lattice,
         const ScanPoints& scan,
         const Poses& starts,
         const Poses& poses,
         int threads)
{
  Candidates candidates(poses.size());
  const auto work = [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i)
      candidates[i] = bestShift(grid, lattice, scan, starts, poses[i]);
  };
  forChunks(poses.size(), threads, work);
  return candidates;
}

/** The best shifts of the best turns of the first start. */
Candidates
searchLattice(const OccupancyGrid& grid,
              const ScanPoints& scan,
              const Poses& starts,
              const PoseSearchRange& range,
              int threads)
{
  const ShiftLattice lattice(grid, range.max_shift, range.shift_step);
  Candidates candidates = shiftAll(grid,
                                   lattice,
                                   thinned(scan, kFirstPoints),
                                   starts,
                                   turnedPoses(starts.front(), range),
                                   threads);
  sortByFit(candidates);
  Poses worthwhile;
  for (const Candidate& candidate : candidates)
    if (worthwhile.size() < kWorthwhile)
      worthwhile.push_back(candidate.pose);
  candidates = shiftAll(grid, lattice, scan, starts, worthwhile, threads);
  sortByFit(candidates);
  return candidates;
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
  const ScanPoints points = sparsePoints(scan, cell_size);
  if (points.empty())
    return {};
  const OccupancyGrid grid(map.points(), starts.front().translation(), cell_size);
  Candidates candidates = searchLattice(grid, points, starts, range, threads);
  candidates = different(candidates, cell_size, 0.8 * range.angle_step, kImproved);
  for (Candidate& candidate : candidates) {
    candidate.fit = grid.fit(points, candidate.pose);
    improve(grid, points, range.angle_step, candidate);
  }
  sortByFit(candidates);
  Poses poses;
  for (const Candidate& candidate :
       different(candidates, 0.7 * cell_size, 0.4 * range.angle_step, most))
    poses.push_back(candidate.pose);
  return poses;
}

} // namespace nurbs
} // namespace pcl
