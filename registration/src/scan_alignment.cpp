// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "scan_alignment.h"

#include "pose_search.h"

#include <pcl/registration/scan_preprocessing.h>

#include <algorithm>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** With less than this of a scan on the map and near it, it may be farther away than
 * turns and a short way. */
constexpr double kFarShare = 0.5;
constexpr double kFarNearShare = 0.7;
/** It is in doubt when it has not settled, or with less than this of what is usual. */
constexpr double kDoubtfulRatio = 0.75;
/** Another place must fit so much better than the predicted one, or by such a share of
 * its fit: more than the choice of points makes. */
constexpr double kBetterFit = 0.05;
constexpr double kBetterFitRatio = 0.2;
/** Iterations that tell a good start from a bad one, and points that do. */
constexpr int kTrialIterations = 15;
constexpr std::size_t kTrialPoints = 1200;
/** Cells of the search, in voxels, and starts that it gives. */
constexpr double kSearchVoxels = 3.0;
constexpr std::size_t kSearchStarts = 4;
constexpr PoseSearchRange kTurns;
constexpr PoseSearchRange kTurnsAndShifts{2.0, 0.35, 8, 2};

/** Whether the surroundings hold so little that other places fit as well. */
bool
isAmbiguous(const MatchResult& match)
{
  return match.degeneracy.unsupported > 0 && match.near_share >= kFarNearShare;
}

/** Whether a scan may have ended in a wrong place. From a start within reach of the
 * right one, Gauss-Newton settles in a few iterations, and as much of the scan lies on
 * the map as of the scans before. From elsewhere pairs keep changing and it creeps. A
 * small share alone says little: a young or sparse map has no surface for many points
 * that are where they belong. */
bool
isDoubtful(const MatchResult& match, double usual_share)
{
  return match.inlier_share < kSureShare && !isAmbiguous(match) &&
         (!match.converged ||
          match.inlier_share < std::max(kLostShare, kDoubtfulRatio * usual_share));
}

bool
isBetter(const MatchResult& match, const MatchResult& than)
{
  const double fit = than.fit();
  return match.fit() > fit + std::min(kBetterFit, kBetterFitRatio * fit);
}

bool
mayBeFar(const MatchResult& match)
{
  return match.inlier_share < kFarShare && match.near_share < kFarNearShare;
}

/** One search for a scan. */
class PlaceSearch {
public:
  PlaceSearch(const VoxelMap& map, const ScanPoints& scan, const MatchOptions& options)
      : map_(map), scan_(scan), few_(thinned(scan, kTrialPoints)), options_(options)
  {
    options_.max_iterations = std::min(kTrialIterations, options.max_iterations);
  }

  /** Try what a search finds around some poses; keep in \a best what fits better.
   * \return whether anything did */
  bool
  improve(const Poses& around, const PoseSearchRange& range, MatchResult& best) const
  {
    bool better = false;
    for (const Eigen::Isometry3d& start :
         searchPoses(map_,
                     scan_,
                     around,
                     range,
                     kSearchVoxels * map_.options().voxel_size,
                     kSearchStarts,
                     options_.threads)) {
      if (best.inlier_share >= kSureShare)
        break;
      MatchResult match = matchScan(map_, few_, {}, start, options_);
      if (!isBetter(match, best))
        continue;
      best = std::move(match);
      better = true;
    }
    return better;
  }

private:
  const VoxelMap& map_;
  const ScanPoints& scan_;
  ScanPoints few_;
  MatchOptions options_;
};

} // namespace

ScanAlignment
alignScan(const VoxelMap& map,
          const ScanPoints& scan,
          const ScanPrediction& prediction,
          const MatchOptions& options)
{
  MatchOptions first = options;
  first.max_iterations = std::min(kTrialIterations, options.max_iterations);
  ScanAlignment result;
  result.match = matchScan(map, scan, {}, prediction.pose, first);
  bool moved = false;
  if (isDoubtful(result.match, prediction.usual_share)) {
    result.searched = true;
    const PlaceSearch search(map, scan, options);
    moved = search.improve({prediction.last, prediction.pose}, kTurns, result.match);
    if (mayBeFar(result.match))
      moved |= search.improve({prediction.last}, kTurnsAndShifts, result.match);
  }
  if (moved || !result.match.converged)
    result.match = matchScan(map, scan, {}, result.match.pose, options);
  return result;
}

} // namespace nurbs
} // namespace pcl
