// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "local_surface.h"

#include <pcl/registration/scan_matching.h>

#include <limits>
#include <optional>
#include <vector>

namespace pcl {
namespace nurbs {

/** A point of the scan and what it belongs to in the target. */
struct MatchPair {
  /** Where the point was when the target was looked up. */
  Eigen::Vector3d place =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  LocalSurface surface;
  /** Where the surface is of, see VoxelMap::blockAt(). */
  std::optional<Eigen::Vector3i> block;
  bool found = false;
};

/** A pair's residual in the scan's frame: square = r' metric r. */
struct PairTerm {
  Eigen::Vector3d residual;
  Eigen::Matrix3d metric;
  double square;
};

/** Finds and keeps the pairs of one alignment. */
class MatchPairs {
public:
  MatchPairs(const VoxelMap& map,
             const ScanPoints& scan,
             const ScanPoints& normals,
             const MatchOptions& options);

  /** Bring the pairs up to date with a pose, and their terms; or only the terms. */
  void
  update(const Eigen::Isometry3d& pose, bool keep_pairs);

  /** From now on look no farther than this for counterparts. */
  void
  setReach(double reach)
  {
    reach_ = reach;
  }

  const std::vector<MatchPair>&
  pairs() const
  {
    return pairs_;
  }

  const PairTerm&
  term(std::size_t i) const
  {
    return terms_[i];
  }

  /** What a pair's term would be if its point lay at another place; nothing without a
   * counterpart there. */
  std::optional<PairTerm>
  termAt(std::size_t i,
         const Eigen::Vector3d& place,
         const Eigen::Matrix3d& rotation) const;

  /** Number of points with a counterpart. */
  std::size_t
  found() const;

  /** Standard deviation of the residuals by their median; 0 without pairs. */
  double
  scale() const;

private:
  void
  lookUp(const Eigen::Vector3d& place, MatchPair& pair) const;

  /** The target's point nearest to a place, given the pair that it had. */
  std::optional<Eigen::Vector3d>
  nearestTo(const Eigen::Vector3d& place, const MatchPair& pair) const;

  PairTerm
  makeTerm(std::size_t i,
           const MatchPair& pair,
           const Eigen::Vector3d& place,
           const Eigen::Matrix3d& rotation) const;

  Eigen::Matrix3d
  metric(std::size_t i,
         const Eigen::Vector3d& normal,
         const Eigen::Vector3d& line) const;

  const VoxelMap& map_;
  const ScanPoints& scan_;
  const ScanPoints& normals_;
  const MatchOptions& options_;
  double reach_;
  std::vector<MatchPair> pairs_;
  std::vector<PairTerm> terms_;
};

} // namespace nurbs
} // namespace pcl
