// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "border_sampling.h"

#include "border_piece.h"
#include "point_welder.h"
#include "segment_distance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kShareOfTolerance = 0.5; // the triangles beside need the rest
constexpr int kMaxHalvings = 20;

/** A piece with its place in the model. */
struct Piece : BorderPiece {
  Piece(const BorderPiece& base, std::size_t of_patch, std::size_t of_loop, bool side)
      : BorderPiece(base), patch(of_patch), loop(of_loop), is_side(side)
  {
  }

  std::size_t patch, loop;
  bool is_side;           // of a domain without loops
  int start = 0, end = 0; // welded corners
};

/** A piece that follows the first piece of its border. */
struct Follower {
  std::size_t piece;
  bool reversed;
};

/** Pieces that are one curve in space. */
struct Border {
  std::size_t leader;
  std::vector<Follower> followers;
};

/** One sample of a border: what each of its pieces has there, leader first. */
struct SharedSample {
  double t; // of the leader
  Eigen::Vector3d position;
  std::vector<Eigen::Vector2d> parameters;
};

class BorderSampler {
public:
  BorderSampler(const std::vector<const TrimmedSurface*>& patches,
                const std::vector<SurfaceGrid>& grids,
                const TessellationOptions& options)
      : grids_(grids), options_(options), corners_(options.weld_tolerance)
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

  std::vector<std::vector<BorderLoop>>
  sample()
  {
    std::vector<std::vector<BorderSample>> samples(pieces_.size());
    for (const Border& border : borders_)
      sampleBorder(border, samples);
    std::vector<std::vector<BorderLoop>> result(loops_.size());
    for (std::size_t k = 0; k < loops_.size(); ++k)
      result[k].resize(loops_[k].size());
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      BorderLoop& loop = result[pieces_[i].patch][pieces_[i].loop];
      // The end of a piece is the start of the next.
      loop.insert(loop.end(), samples[i].begin(), samples[i].end() - 1);
    }
    return result;
  }

private:
  void
  addPieces(const NurbsSurface& surface,
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
  join(std::size_t piece)
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
  coincide(std::size_t leader, const Follower& follower) const
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
          (b.position(s) - target).norm() > options_.weld_tolerance)
        return false;
      last = s;
    }
    return true;
  }

  /** Parameter of the follower where the leader has \a target. */
  double
  follow(std::size_t leader,
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
    if ((b.position(near) - target).norm() <= options_.weld_tolerance)
      return near;
    return b.projectFromAnywhere(target);
  }

  /** On a grid line where rounding only just missed it, so that the cells beside the
   * line stay whole. */
  Eigen::Vector2d
  snappedParameter(const Piece& piece, double t) const
  {
    constexpr double kRounding = 1e-9; // of a cell
    const SurfaceGrid& grid = grids_[piece.patch];
    Eigen::Vector2d uv = piece.parameter(t);
    const Eigen::Vector2d cell = grid.cellCoordinates(uv);
    const Eigen::Vector2d line = cell.array().round();
    if (std::abs(cell.x() - line.x()) <= kRounding)
      uv.x() = grid.u()[static_cast<std::size_t>(line.x())];
    if (std::abs(cell.y() - line.y()) <= kRounding)
      uv.y() = grid.v()[static_cast<std::size_t>(line.y())];
    return uv;
  }

  SharedSample
  shared(const Border& border, double t) const
  {
    const Piece& leader = pieces_[border.leader];
    SharedSample sample{t, leader.position(t), {snappedParameter(leader, t)}};
    for (const Follower& follower : border.followers)
      sample.parameters.push_back(
          snappedParameter(pieces_[follower.piece],
                           follow(border.leader, follower, t, sample.position)));
    return sample;
  }

  /** Where sampling starts: lines of the grid on a side, spans of a curve. */
  std::vector<double>
  startingBreaks(const Piece& piece) const
  {
    if (piece.is_side) {
      const bool along_u =
          piece.parameter(piece.first()).y() == piece.parameter(piece.last()).y();
      const SurfaceGrid& grid = grids_[piece.patch];
      std::vector<double> lines = along_u ? grid.u() : grid.v();
      const int axis = along_u ? 0 : 1;
      if (piece.parameter(piece.first())(axis) > piece.parameter(piece.last())(axis))
        for (double& line : lines)
          line = piece.first() + piece.last() - line;
      std::sort(lines.begin(), lines.end());
      return lines;
    }
    if (piece.curve().degree() == 1)
      return {piece.first(), piece.last()};
    const std::vector<double> spans = piece.curve().knots().breaks();
    std::vector<double> breaks;
    const int parts = piece.curve().degree(); // no bend hides between the probes
    for (std::size_t i = 0; i + 1 < spans.size(); ++i)
      for (int k = 0; k < parts; ++k)
        breaks.push_back(spans[i] + (spans[i + 1] - spans[i]) * k / parts);
    breaks.push_back(spans.back());
    return breaks;
  }

  bool
  isFine(const Border& border, const SharedSample& a, const SharedSample& b) const
  {
    constexpr double kRoundedUp = 1.0 + 1e-9;
    for (std::size_t k = 0; k < a.parameters.size(); ++k) {
      const std::size_t piece = k == 0 ? border.leader : border.followers[k - 1].piece;
      const SurfaceGrid& grid = grids_[pieces_[piece].patch];
      const Eigen::Vector2d cells =
          grid.cellCoordinates(a.parameters[k]) - grid.cellCoordinates(b.parameters[k]);
      if (cells.cwiseAbs().maxCoeff() > kRoundedUp)
        return false;
    }
    if (options_.max_edge_length > 0.0 &&
        (b.position - a.position).norm() > kRoundedUp * options_.max_edge_length)
      return false;
    for (const double f : {0.5, 0.25, 0.75}) {
      const Eigen::Vector3d on_curve =
          pieces_[border.leader].position(a.t + f * (b.t - a.t));
      if (segmentDistance<3>(on_curve, a.position, b.position) >
          kShareOfTolerance * options_.chord_tolerance)
        return false;
    }
    return true;
  }

  /** Appends what lies between \a a and \a b, then \a b. */
  void
  refine(const Border& border,
         const SharedSample& a,
         const SharedSample& b,
         int halvings,
         std::vector<SharedSample>& samples) const
  {
    if (halvings > 0 && !isFine(border, a, b)) {
      const SharedSample middle = shared(border, 0.5 * (a.t + b.t));
      refine(border, a, middle, halvings - 1, samples);
      refine(border, middle, b, halvings - 1, samples);
      return;
    }
    samples.push_back(b);
  }

  void
  sampleBorder(const Border& border,
               std::vector<std::vector<BorderSample>>& result) const
  {
    const Piece& leader = pieces_[border.leader];
    std::vector<SharedSample> samples;
    const std::vector<double> breaks = startingBreaks(leader);
    samples.push_back(shared(border, breaks.front()));
    for (std::size_t i = 1; i < breaks.size(); ++i)
      refine(border,
             SharedSample(samples.back()),
             shared(border, breaks[i]),
             kMaxHalvings,
             samples);
    samples.front().position = corners_.point(leader.start);
    samples.back().position = corners_.point(leader.end);
    const bool is_pole =
        std::all_of(samples.begin(), samples.end(), [&](const SharedSample& sample) {
          return (sample.position - samples.front().position).norm() <=
                 options_.weld_tolerance;
        });
    for (std::size_t k = 0; k <= border.followers.size(); ++k) {
      const bool reversed = k > 0 && border.followers[k - 1].reversed;
      auto& out = result[k == 0 ? border.leader : border.followers[k - 1].piece];
      for (const SharedSample& sample : samples)
        out.push_back({sample.parameters[k],
                       is_pole ? samples.front().position : sample.position});
      if (reversed)
        std::reverse(out.begin(), out.end());
    }
  }

  const std::vector<SurfaceGrid>& grids_;
  const TessellationOptions& options_;
  PointWelder corners_;
  std::vector<std::vector<TrimLoop>> loops_;
  std::vector<Piece> pieces_;
  std::vector<Border> borders_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> borders_between_;
};

} // namespace

std::vector<std::vector<BorderLoop>>
sampleBorders(const std::vector<const TrimmedSurface*>& patches,
              const std::vector<SurfaceGrid>& grids,
              const TessellationOptions& options)
{
  return BorderSampler(patches, grids, options).sample();
}

} // namespace nurbs
} // namespace pcl
