// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/loop_detector.h>
#include <pcl/registration/scan_matching.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kCoarse = 4.0; // voxels of the first alignment, in those of the last
constexpr double kCoarseDistance = 10.0; // of pairs, in voxels of the last

/** Points of a keyframe and its neighbours, in its frame. */
VoxelMap
surroundings(const std::vector<Keyframe>& keyframes,
             std::size_t center,
             double voxel_size)
{
  VoxelMapOptions options;
  options.min_spacing *= voxel_size / options.voxel_size;
  options.voxel_size = voxel_size;
  VoxelMap map(options);
  const Eigen::Isometry3d T_center_odometry =
      keyframes[center].T_odometry_keyframe.inverse();
  const std::size_t first = center > 0 ? center - 1 : 0;
  for (std::size_t k = first; k <= std::min(center + 1, keyframes.size() - 1); ++k) {
    const Eigen::Isometry3d T_center_k =
        T_center_odometry * keyframes[k].T_odometry_keyframe;
    for (const Eigen::Vector3f& point : keyframes[k].points)
      map.insert(T_center_k * point.cast<double>());
  }
  return map;
}

TangentMatrix
floorOf(double translation, double rotation)
{
  TangentMatrix floor = TangentMatrix::Zero();
  floor.diagonal().head<3>().setConstant(translation * translation);
  floor.diagonal().tail<3>().setConstant(rotation * rotation);
  return floor;
}

} // namespace

LoopDetector::~LoopDetector() = default;

std::vector<BetweenFactor>
ProximityLoopDetector::detect(const std::vector<Keyframe>& keyframes,
                              const PoseGraph& graph)
{
  const std::size_t last = keyframes.size() - 1;
  recent_.erase(std::remove_if(recent_.begin(),
                               recent_.end(),
                               [&](const Candidate& old) {
                                 return old.to + options_.max_cycle_keyframes < last;
                               }),
                recent_.end());
  const std::optional<std::size_t> from = nearest(keyframes, graph);
  if (!from)
    return {};
  const Eigen::Isometry3d guess =
      graph.node(keyframes[*from].node).T_world_node.inverse() *
      graph.node(keyframes[last].node).T_world_node;
  std::optional<Candidate> found = verify(keyframes, *from, guess);
  if (!found)
    return {};
  std::vector<BetweenFactor> sure;
  for (Candidate& other : recent_)
    if (consistent(keyframes, other, *found)) {
      if (!other.returned)
        sure.push_back(other.factor);
      other.returned = found->returned = true;
    }
  if (found->returned)
    sure.push_back(found->factor);
  recent_.push_back(std::move(*found));
  return sure;
}

std::optional<std::size_t>
ProximityLoopDetector::nearest(const std::vector<Keyframe>& keyframes,
                               const PoseGraph& graph) const
{
  const Keyframe& last = keyframes.back();
  const Eigen::Vector3d place = graph.node(last.node).T_world_node.translation();
  std::optional<std::size_t> best;
  double best_distance = options_.max_reach;
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    const double way = last.way - keyframes[k].way;
    if (way < options_.min_way)
      break;
    const double distance =
        (graph.node(keyframes[k].node).T_world_node.translation() - place).norm();
    const double reach = std::max(options_.min_reach, options_.drift_share * way);
    if (distance <= std::min(reach, best_distance)) {
      best_distance = distance;
      best = k;
    }
  }
  return best;
}

std::optional<ProximityLoopDetector::Candidate>
ProximityLoopDetector::verify(const std::vector<Keyframe>& keyframes,
                              std::size_t from,
                              const Eigen::Isometry3d& guess) const
{
  const Keyframe& last = keyframes.back();
  MatchOptions match;
  match.threads = options_.threads;
  match.max_distance = kCoarseDistance * options_.voxel_size;
  const VoxelMap coarse = surroundings(keyframes, from, kCoarse * options_.voxel_size);
  const MatchResult rough = matchScan(coarse, last.points, {}, guess, match);
  if (!rough.converged)
    return std::nullopt;
  match.max_distance = options_.voxel_size;
  const VoxelMap fine = surroundings(keyframes, from, options_.voxel_size);
  const MatchResult result = matchScan(fine, last.points, {}, rough.pose, match);
  const double overlap = static_cast<double>(result.correspondences) /
                         static_cast<double>(last.points.size());
  if (!result.converged || result.degeneracy.unsupported > 0 ||
      overlap < options_.min_overlap ||
      result.rmse > options_.max_rmse_share * options_.voxel_size)
    return std::nullopt;
  const TangentMatrix covariance =
      result.covariance +
      floorOf(options_.min_sigma_translation, options_.min_sigma_rotation);
  return Candidate{from,
                   keyframes.size() - 1,
                   {keyframes[from].node, last.node, result.pose, covariance.inverse()},
                   false};
}

bool
ProximityLoopDetector::consistent(const std::vector<Keyframe>& keyframes,
                                  const Candidate& a,
                                  const Candidate& b) const
{
  const auto motion = [&](std::size_t from, std::size_t to) -> Eigen::Isometry3d {
    return keyframes[from].T_odometry_keyframe.inverse() *
           keyframes[to].T_odometry_keyframe;
  };
  if (std::max(a.from, b.from) - std::min(a.from, b.from) >
      options_.max_cycle_keyframes)
    return false;
  const Eigen::Isometry3d cycle = b.factor.T_from_to.inverse() *
                                  motion(b.from, a.from) * a.factor.T_from_to *
                                  motion(a.to, b.to);
  return cycle.translation().norm() <= options_.max_cycle_distance &&
         Eigen::AngleAxisd(cycle.linear()).angle() <= options_.max_cycle_angle;
}

} // namespace nurbs
} // namespace pcl
