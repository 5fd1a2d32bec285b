// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "match_pairs.h"

#include "chunked_sum.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** A pair is looked up again when its point has moved by so many voxels: the iteration
 * ends with many small steps. More than this leaves a bias towards the guess. */
constexpr double kStaleMove = 0.01;
/** Nor by so many of the steps that end the iteration: who asks for smaller ones wants
 * no such bias. */
constexpr double kStaleSteps = 50.0;
/** The same for a point that found nothing, which is the most costly thing to find. */
constexpr double kStaleMiss = 0.4;
/** Thickness of a plane in Generalized ICP, as a variance relative to its extent. */
constexpr double kPlaneThickness = 1e-3;
/** Standard deviation over median of absolute values: a normal distribution in one
 * dimension. */
constexpr double kMedianToSigma = 1.4826;

/** How the distance to the nearest point changes when a point of a map moves by a voxel
 * to either side. */
Eigen::Matrix3d
heldAround(const VoxelMap& map, const Eigen::Vector3d& target)
{
  const double step = map.options().voxel_size;
  Eigen::Matrix3d slope;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d way = step * Eigen::Vector3d::Unit(k);
    const auto ahead = map.nearest(target + way, 1.01 * step).value_or(target);
    const auto behind = map.nearest(target - way, 1.01 * step).value_or(target);
    slope.col(k) = Eigen::Vector3d::Unit(k) - (ahead - behind) / (2.0 * step);
  }
  return 0.5 * (slope + slope.transpose());
}

} // namespace

MatchPairs::MatchPairs(const VoxelMap& map,
                       const ScanPoints& scan,
                       const ScanPoints& normals,
                       const MatchOptions& options)
    : map_(map),
      scan_(scan),
      normals_(normals),
      options_(options),
      reach_(options.max_distance),
      pairs_(scan.size()),
      terms_(scan.size())
{
}

void
MatchPairs::lookUp(const Eigen::Vector3d& place, MatchPair& pair) const
{
  pair.place = place;
  const auto nearest = nearestTo(place, pair);
  pair.found = nearest.has_value();
  if (!pair.found)
    return;
  pair.target = *nearest;
  const auto block = map_.blockAt(*nearest);
  if (block && pair.block && *block == *pair.block)
    return;
  pair.block = block;
  pair.surface = localSurface(block ? map_.surfaceOfBlock(*block) : PointMoments());
  if (pair.surface.scattered) // as for all targets within a block
    pair.surface.held = heldAround(map_, pair.target);
}

std::optional<Eigen::Vector3d>
MatchPairs::nearestTo(const Eigen::Vector3d& place, const MatchPair& pair) const
{
  constexpr double kMargin = 1.0 + 1e-5; // more than rounding to single precision
  if (pair.found) {                      // no farther than the point it had is
    const double known = kMargin * (place - pair.target).norm();
    if (known < reach_)
      if (auto nearest = map_.nearest(place, known))
        return nearest;
  }
  return map_.nearest(place, reach_);
}

Eigen::Matrix3d
MatchPairs::metric(std::size_t i,
                   const Eigen::Vector3d& normal,
                   const Eigen::Vector3d& line) const
{
  Eigen::Matrix3d plane = normal * normal.transpose();
  switch (options_.metric) {
  case MatchMetric::PointToPoint:
    break;
  case MatchMetric::PointToPlane:
    if (normal.isZero(0.0))
      return options_.scatter_weight *
             (Eigen::Matrix3d::Identity() - line * line.transpose());
    return plane;
  case MatchMetric::PlaneToPlane: {
    const Eigen::Vector3d own = normals_[i].cast<double>();
    const Eigen::Matrix3d both =
        2.0 * Eigen::Matrix3d::Identity() -
        (1.0 - kPlaneThickness) * (plane + own * own.transpose());
    // So scaled that two equal planes have the metric of PointToPlane.
    return 2.0 * kPlaneThickness * both.inverse();
  }
  }
  return Eigen::Matrix3d::Identity();
}

PairTerm
MatchPairs::makeTerm(std::size_t i,
                     const MatchPair& pair,
                     const Eigen::Vector3d& place,
                     const Eigen::Matrix3d& rotation) const
{
  // On a plane the mean of all its points has less noise than the nearest one.
  const bool plane =
      options_.metric == MatchMetric::PointToPlane && pair.surface.flat();
  PairTerm term;
  term.residual =
      rotation.transpose() * (place - (plane ? pair.surface.mean : pair.target));
  term.metric = metric(i,
                       rotation.transpose() * pair.surface.normal,
                       rotation.transpose() * pair.surface.line);
  term.square = term.residual.dot(term.metric * term.residual);
  return term;
}

void
MatchPairs::update(const Eigen::Isometry3d& pose, bool keep_pairs)
{
  const double size = map_.options().voxel_size;
  const double moved =
      std::min(size * kStaleMove, kStaleSteps * options_.translation_epsilon);
  const auto work = [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d place = pose * scan_[i].cast<double>();
      MatchPair& pair = pairs_[i];
      const double stale = pair.found ? moved : size * kStaleMiss;
      if (!keep_pairs && !((place - pair.place).squaredNorm() < stale * stale))
        lookUp(place, pair);
      if (pair.found)
        terms_[i] = makeTerm(i, pair, place, pose.linear());
    }
  };
  forChunks(scan_.size(), options_.threads, work);
}

std::optional<PairTerm>
MatchPairs::termAt(std::size_t i,
                   const Eigen::Vector3d& place,
                   const Eigen::Matrix3d& rotation) const
{
  MatchPair pair = pairs_[i];
  lookUp(place, pair);
  if (!pair.found)
    return std::nullopt;
  return makeTerm(i, pair, place, rotation);
}

std::size_t
MatchPairs::found() const
{
  return static_cast<std::size_t>(std::count_if(
      pairs_.begin(), pairs_.end(), [](const MatchPair& pair) { return pair.found; }));
}

double
MatchPairs::scale() const
{
  std::vector<double> squares;
  squares.reserve(pairs_.size());
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if (pairs_[i].found)
      squares.push_back(terms_[i].square);
  if (squares.empty())
    return 0.0;
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return kMedianToSigma * std::sqrt(*middle);
}

} // namespace nurbs
} // namespace pcl
