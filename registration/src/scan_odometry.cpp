// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/registration/scan_odometry.h>
#include <pcl/registration/scan_preprocessing.h>

#include "pose_search.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Scans that may fail before the map is begun anew. */
constexpr int kMostLost = 5;
/** The map is cleared of far points after so much way, as a share of the range. */
constexpr double kPruneShare = 0.05;
/** With so much of a scan on the map there is no better place for it ... */
constexpr double kSureShare = 0.7;
/** ... with less than this it may be farther away than turns and a short way ... */
constexpr double kDoubtfulShare = 0.4;
/** ... and with less than this it is lost. */
constexpr double kLostShare = 0.25;
/** Another place must fit so much better than the predicted one. */
constexpr double kBetterShare = 0.05;
/** Cells of the search, in voxels, and starts that it gives. */
constexpr double kSearchVoxels = 3.0;
constexpr std::size_t kSearchStarts = 3;

void
check(const OdometryOptions& options)
{
  if (!(options.min_range >= 0.0) || !(options.max_range > options.min_range))
    throw std::invalid_argument("ScanOdometry: the ranges must be in order");
  if (!(options.map_spacing > 0.0) || !(options.match_spacing > 0.0))
    throw std::invalid_argument("ScanOdometry: spacings must be positive");
  if (options.threads < 1)
    throw std::invalid_argument("ScanOdometry: at least one thread is needed");
}

double
angleOf(const Eigen::Isometry3d& motion)
{
  return Eigen::AngleAxisd(motion.linear()).angle();
}

} // namespace

OdometryOptions
OdometryOptions::lidar()
{
  return {};
}

OdometryOptions
OdometryOptions::rgbd()
{
  OdometryOptions options;
  options.min_range = 0.1;
  options.max_range = 10.0;
  options.deskew = false;
  options.map.voxel_size = 0.06;
  options.map.min_spacing = 0.012;
  options.map_spacing = 0.015;
  options.match_spacing = 0.06;
  options.threshold.initial = 0.1;
  options.threshold.min_motion = 0.01;
  options.threshold.min_threshold = 0.05;
  options.threshold.max_threshold = 0.3;
  options.threshold.max_range = 3.0;
  options.match.translation_epsilon = 1e-5;
  options.keyframe_distance = 0.3;
  return options;
}

ScanOdometry::ScanOdometry(const OdometryOptions& options)
    : options_(options), map_(options.map), threshold_(options.threshold)
{
  check(options);
  options_.match.threads = options.threads;
}

ScanOdometry::~ScanOdometry() = default;

void
ScanOdometry::setKeyframeDecision(KeyframeDecision decision)
{
  decision_ = std::move(decision);
}

ScanPoints
ScanOdometry::prepare(const ScanPoints& points, const std::vector<float>& times) const
{
  const auto nearest = static_cast<float>(options_.min_range * options_.min_range);
  const auto farthest = static_cast<float>(options_.max_range * options_.max_range);
  ScanPoints kept;
  std::vector<float> kept_times;
  kept.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float square = points[i].squaredNorm();
    if (!(square >= nearest && square <= farthest)) // false for NaN
      continue;
    kept.push_back(points[i]);
    if (!times.empty())
      kept_times.push_back(times[i]);
  }
  if (options_.vertical_angle != 0.0)
    correctVerticalAngle(kept, options_.vertical_angle);
  if (options_.deskew && !times.empty())
    deskew(kept, kept_times, velocity_, options_.reference_time, options_.threads);
  return voxelSubsample(kept, options_.map_spacing);
}

OdometryResult
ScanOdometry::process(const ScanPoints& points, const std::vector<float>& times)
{
  if (!times.empty() && times.size() != points.size())
    throw std::invalid_argument("ScanOdometry: one time per point is needed");
  OdometryResult result;
  result.points = prepare(points, times);
  result.pose = pose_ * velocity_;
  if (map_.empty())
    result.tracked = !result.points.empty();
  else
    track(result);
  lost_ = result.tracked ? 0 : lost_ + 1;
  if (lost_ > kMostLost && !result.points.empty())
    map_.clear();
  if (result.tracked || map_.empty())
    insert(result);
  decideKeyframe(result);
  pose_ = result.pose;
  return result;
}

void
ScanOdometry::tryStart(const ScanPoints& scan,
                       const Eigen::Isometry3d& start,
                       OdometryResult& result) const
{
  MatchOptions options = options_.match;
  options.max_distance = result.threshold;
  MatchResult match = matchScan(map_, scan, {}, start, options);
  if (!match.converged)
    return;
  if (result.match.converged &&
      match.inlier_share < result.match.inlier_share + kBetterShare)
    return;
  result.match = std::move(match);
}

void
ScanOdometry::searchStarts(const ScanPoints& scan,
                           const PoseSearchRange& range,
                           OdometryResult& result) const
{
  result.searched = true;
  const Poses starts = searchPoses(map_,
                                   scan,
                                   {pose_, result.pose},
                                   range,
                                   kSearchVoxels * options_.map.voxel_size,
                                   kSearchStarts,
                                   options_.threads);
  for (const Eigen::Isometry3d& start : starts)
    if (result.match.inlier_share < kSureShare)
      tryStart(scan, start, result);
}

void
ScanOdometry::track(OdometryResult& result)
{
  const ScanPoints scan = voxelSubsample(result.points, options_.match_spacing);
  const Eigen::Isometry3d predicted = result.pose;
  result.threshold = threshold_.value();
  tryStart(scan, predicted, result);
  if (result.match.inlier_share < kSureShare)
    searchStarts(scan, {}, result);
  if (result.match.inlier_share < kDoubtfulShare)
    searchStarts(scan, {2.0, 0.35, 8, 2}, result);
  result.tracked = result.match.converged && result.match.inlier_share >= kLostShare;
  if (!result.tracked)
    return;
  result.pose = result.match.pose;
  threshold_.addDeviation(predicted.inverse() * result.pose);
  velocity_ = orthonormal(pose_.inverse() * result.pose);
}

void
ScanOdometry::insert(const OdometryResult& result)
{
  for (const Eigen::Vector3f& point : result.points)
    map_.insert(result.pose * point.cast<double>());
  const Eigen::Vector3d place = result.pose.translation();
  if ((place - pruned_at_).norm() < kPruneShare * options_.max_range)
    return;
  map_.removeFarFrom(place, options_.max_range);
  pruned_at_ = place;
}

bool
ScanOdometry::isKeyframe(const OdometryResult& result) const
{
  if (!any_keyframe_)
    return true;
  const Eigen::Isometry3d since = keyframe_.inverse() * result.pose;
  if (decision_)
    return decision_(result, since);
  return since.translation().norm() >= options_.keyframe_distance ||
         angleOf(since) >= options_.keyframe_angle;
}

void
ScanOdometry::decideKeyframe(OdometryResult& result)
{
  if (!result.tracked)
    return;
  result.keyframe = isKeyframe(result);
  if (!result.keyframe)
    return;
  any_keyframe_ = true;
  keyframe_ = result.pose;
}

std::vector<Eigen::Vector3d>
ScanOdometry::localMap() const
{
  return map_.points();
}

} // namespace nurbs
} // namespace pcl
