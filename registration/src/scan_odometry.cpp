// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/registration/scan_odometry.h>
#include <pcl/registration/scan_preprocessing.h>

#include "point_selection.h"
#include "scan_alignment.h"

#include <algorithm>
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
/** It is lost with less than kLostShare, or with less than half of what is usual. */
constexpr double kLostRatio = 0.5;
/** Intervals that tell a velocity, and for which one tells the motion. */
constexpr double kShortestInterval = 0.1;
constexpr double kLongestInterval = 10.0;
/** Weight of the last scan in what is usual. */
constexpr double kShareUpdate = 0.2;

void
check(const OdometryOptions& options)
{
  if (!(options.min_range >= 0.0) || !(options.max_range > options.min_range))
    throw std::invalid_argument("ScanOdometry: the ranges must be in order");
  if (!(options.map_spacing > 0.0) || !(options.match_spacing > 0.0))
    throw std::invalid_argument("ScanOdometry: spacings must be positive");
  if (!(options.first_voxels > 0.0) || !(options.first_way >= 0.0))
    throw std::invalid_argument("ScanOdometry: the first map's voxels must be positive "
                                "and its way not negative");
  if (options.threads < 1)
    throw std::invalid_argument("ScanOdometry: at least one thread is needed");
}

/** A part of a motion, or more than all of it, at constant velocity. */
Eigen::Isometry3d
scaled(const Eigen::Isometry3d& motion, double factor)
{
  if (factor == 1.0)
    return motion;
  return exponential(factor * logarithm(motion));
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
  options.calibrate_beams = false;
  options.map.voxel_size = 0.06;
  options.map.min_spacing = 0.012;
  options.map_spacing = 0.015;
  options.match_spacing = 0.06;
  options.threshold.initial = 0.1;
  options.threshold.min_motion = 0.01;
  options.threshold.min_threshold = 0.05;
  options.threshold.max_threshold = 0.3;
  options.threshold.max_range = 3.0;
  // Normals of dense images are surer than those of lasers, and images hold less.
  options.match.min_support = 2e-4;
  options.match.translation_epsilon = 5e-5;
  options.match.rotation_epsilon = 5e-5;
  options.keyframe_distance = 0.3;
  return options;
}

ScanOdometry::ScanOdometry(const OdometryOptions& options)
    : options_(options),
      map_(options.map),
      calibration_(options.beams),
      threshold_(options.threshold)
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
ScanOdometry::prepare(const ScanPoints& points,
                      const std::vector<float>& times,
                      Readings& readings) const
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
  readings.sparse = mayBegin() && isSparse(kept);
  if (options_.calibrate_beams) {
    readings.beams = BeamCalibration::beamsOf(kept);
    calibration_.correct(kept, readings.beams);
    readings.points = kept;
  }
  if (options_.deskew && !times.empty())
    deskew(kept, kept_times, velocity_, options_.reference_time, options_.threads);
  const std::vector<std::size_t> some =
      voxelSubsampleIndices(kept, options_.map_spacing);
  if (options_.calibrate_beams)
    readings = {selected(readings.points, some),
                selected(readings.beams, some),
                readings.sparse};
  return selected(kept, some);
}

OdometryResult
ScanOdometry::process(const ScanPoints& points,
                      const std::vector<float>& times,
                      double interval)
{
  if (!times.empty() && times.size() != points.size())
    throw std::invalid_argument("ScanOdometry: one time per point is needed");
  if (!(interval >= 0.0))
    throw std::invalid_argument("ScanOdometry: time does not run backwards");
  OdometryResult result;
  Readings readings;
  result.points = prepare(points, times, readings);
  result.pose = pose_ * scaled(velocity_, std::min(interval, kLongestInterval));
  if (map_.empty())
    result.tracked = !result.points.empty();
  else
    track(interval, readings, result);
  lost_ = result.tracked ? 0 : lost_ + 1;
  if (lost_ > kMostLost && !result.points.empty())
    clearMap();
  if (result.tracked || map_.empty())
    insert(result, readings.sparse);
  decideKeyframe(result);
  pose_ = result.pose;
  return result;
}

void
ScanOdometry::track(double interval, const Readings& readings, OdometryResult& result)
{
  const Eigen::Isometry3d predicted = result.pose;
  result.threshold = threshold_.value();
  MatchOptions match = options_.match;
  match.max_distance = result.threshold;
  const std::vector<std::size_t> some =
      evenlyChosen(voxelSubsampleIndices(result.points, options_.match_spacing),
                   options_.max_match_points);
  const ScanPoints scan = selected(result.points, some);
  ScanAlignment alignment =
      alignScan(target(), scan, {predicted, pose_, usual_share_}, match);
  result.match = std::move(alignment.match);
  result.searched = alignment.searched;
  const double share = result.match.inlier_share;
  result.tracked = result.match.converged &&
                   share >= std::max(kLostShare, kLostRatio * usual_share_);
  if (!result.tracked)
    return;
  usual_share_ += (usual_share_ > 0.0 ? kShareUpdate : 1.0) * (share - usual_share_);
  result.pose = result.match.pose;
  threshold_.addDeviation(predicted.inverse() * result.pose);
  if (options_.calibrate_beams && !first_map_ &&
      result.match.degeneracy.unsupported == 0)
    calibration_.learn(map_,
                       scan,
                       selected(readings.points, some),
                       selected(readings.beams, some),
                       result.pose,
                       options_.threads);
  if (interval >= kShortestInterval)
    velocity_ = scaled(orthonormal(pose_.inverse() * result.pose), 1.0 / interval);
}

void
ScanOdometry::clearMap()
{
  map_.clear();
  first_map_.reset();
  usual_share_ = 0.0;
}

bool
ScanOdometry::mayBegin() const
{
  return map_.empty() || lost_ >= kMostLost;
}

void
ScanOdometry::updateFirstMap(const OdometryResult& result, bool sparse)
{
  if (map_.empty() && sparse && options_.first_way > 0.0) {
    VoxelMapOptions options = options_.map;
    options.voxel_size = std::max(
        options.voxel_size, options_.first_voxels * suitableVoxelSize(result.points));
    options.min_spacing *= options.voxel_size / options_.map.voxel_size;
    first_map_.emplace(options);
    first_way_ = 0.0;
  }
  if (!first_map_)
    return;
  first_way_ += (result.pose.translation() - pose_.translation()).norm();
  if (first_way_ > options_.first_way * first_map_->options().voxel_size) {
    first_map_.reset();
    usual_share_ = 0.0; // of a scan that lies on the other map
    return;
  }
  for (const Eigen::Vector3f& point : result.points)
    first_map_->insert(result.pose * point.cast<double>());
}

void
ScanOdometry::insert(const OdometryResult& result, bool sparse)
{
  updateFirstMap(result, sparse);
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
