// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "border_matching.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {

BorderMatcher::BorderMatcher(const std::vector<const TrimmedSurface*>& patches,
                             double weld_tolerance)
    : weld_tolerance_(weld_tolerance), corners_(weld_tolerance)
{
  for (const TrimmedSurface* patch : patches)
    loops_.push_back(patch->isTrimmed()
                         ? patch->loops()
                         : std::vector{TrimLoop::ofDomain(patch->surface())});
  for (std::size_t k = 0; k < patches.size(); ++k)
    for (std::size_t loop = 0; loop < loops_[k].size(); ++loop)
      for (const NurbsCurve2& curve : loops_[k][loop].curves())
        addPieces(patches[k]->surface(), curve, k, loop, !patches[k]->isTrimmed());
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece)
    join(piece);
}

void
BorderMatcher::addPieces(const NurbsSurface& surface,
                         const NurbsCurve2& curve,
                         std::size_t patch,
                         std::size_t loop,
                         bool is_side)
{
  const std::vector<double> breaks = curve.knots().breaks();
  const std::size_t step = curve.degree() == 1 ? 1 : breaks.size() - 1;
  for (std::size_t i = 0; i + step < breaks.size(); i += step) {
    Piece piece({surface, curve, breaks[i], breaks[i + step]}, patch, loop, is_side);
    const bool is_point =
        step == 1 && curve.degree() == 1 &&
        piece.parameter(piece.first()) == piece.parameter(piece.last());
    if (is_point)
      continue;
    piece.start = corners_.add(piece.position(piece.first()));
    piece.end = corners_.add(piece.position(piece.last()));
    pieces_.push_back(piece);
  }
}

void
BorderMatcher::join(std::size_t piece)
{
  const auto [low, high] = std::minmax(pieces_[piece].start, pieces_[piece].end);
  std::vector<std::size_t>& candidates = borders_between_[{low, high}];
  for (const std::size_t border : candidates)
    for (const bool reversed : {true, false})
      if (coincide(borders_[border].leader, {piece, reversed})) {
        borders_[border].followers.push_back({piece, reversed});
        return;
      }
  candidates.push_back(borders_.size());
  borders_.push_back({piece, {}});
}

bool
BorderMatcher::coincide(std::size_t leader, const Follower& follower) const
{
  const Piece& a = pieces_[leader];
  const Piece& b = pieces_[follower.piece];
  if ((follower.reversed ? b.end : b.start) != a.start)
    return false;
  double last = follower.reversed ? HUGE_VAL : -HUGE_VAL;
  for (const double f : {0.25, 0.5, 0.75}) {
    const double t = a.first() + f * (a.last() - a.first());
    const Eigen::Vector3d target = a.position(t);
    const double s = follow(leader, follower, t, target);
    // Only the order tells the two senses of a closed curve apart.
    if ((follower.reversed ? s >= last : s <= last) ||
        (b.position(s) - target).norm() > weld_tolerance_)
      return false;
    last = s;
  }
  return true;
}

double
BorderMatcher::follow(std::size_t leader,
                      const Follower& follower,
                      double t,
                      const Eigen::Vector3d& target) const
{
  const Piece& a = pieces_[leader];
  const Piece& b = pieces_[follower.piece];
  const double f = (t - a.first()) / (a.last() - a.first());
  const double proportional =
      b.first() + (follower.reversed ? 1.0 - f : f) * (b.last() - b.first());
  const double near = b.project(target, proportional);
  if ((b.position(near) - target).norm() <= weld_tolerance_)
    return near;
  return b.projectFromAnywhere(target);
}

} // namespace nurbs
} // namespace pcl
