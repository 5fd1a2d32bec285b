// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "border_sampling.h"

#include "border_matching.h"
#include "segment_distance.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kShareOfTolerance = 0.5; // the triangles beside need the rest
constexpr int kMaxHalvings = 20;

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
      : matcher_(patches, options.weld_tolerance),
        pieces_(matcher_.pieces()),
        grids_(grids),
        options_(options)
  {
  }

  std::vector<std::vector<BorderLoop>>
  sample()
  {
    std::vector<std::vector<BorderSample>> samples(pieces_.size());
    for (const Border& border : matcher_.borders())
      sampleBorder(border, samples);
    std::vector<std::vector<BorderLoop>> result;
    for (const std::vector<TrimLoop>& loops : matcher_.loops())
      result.emplace_back(loops.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      BorderLoop& loop = result[pieces_[i].patch][pieces_[i].loop];
      // The end of a piece is the start of the next.
      loop.insert(loop.end(), samples[i].begin(), samples[i].end() - 1);
    }
    return result;
  }

private:
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
      sample.parameters.push_back(snappedParameter(
          pieces_[follower.piece],
          matcher_.follow(border.leader, follower, t, sample.position)));
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

  const SurfaceGrid&
  gridOf(const Border& border, std::size_t k) const
  {
    const std::size_t piece = k == 0 ? border.leader : border.followers[k - 1].piece;
    return grids_[pieces_[piece].patch];
  }

  bool
  isFine(const Border& border, const SharedSample& a, const SharedSample& b) const
  {
    constexpr double kRoundedUp = 1.0 + 1e-9;
    for (std::size_t k = 0; k < a.parameters.size(); ++k) {
      const SurfaceGrid& grid = gridOf(border, k);
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

  /** Coordinate in cells, along one axis, of piece \a k of a border. */
  double
  cellCoordinate(const Border& border,
                 const SharedSample& sample,
                 std::size_t k,
                 int axis) const
  {
    return gridOf(border, k).cellCoordinates(sample.parameters[k])(axis);
  }

  /** Parameter of the leader where a piece crosses a crease of its surface. */
  std::optional<double>
  creaseCrossing(const Border& border,
                 const SharedSample& a,
                 const SharedSample& b) const
  {
    constexpr int kBisections = 60;
    for (std::size_t k = 0; k < a.parameters.size(); ++k)
      for (const int axis : {0, 1}) {
        const double from = cellCoordinate(border, a, k, axis);
        const double to = cellCoordinate(border, b, k, axis);
        const int line = gridOf(border, k).creaseBetween(axis, from, to);
        if (line < 0)
          continue;
        double below = from < to ? a.t : b.t;
        double above = from < to ? b.t : a.t;
        for (int n = 0; n < kBisections; ++n) {
          const double t = 0.5 * (below + above);
          (cellCoordinate(border, shared(border, t), k, axis) < line ? below : above) =
              t;
        }
        return above;
      }
    return std::nullopt;
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
    if (const std::optional<double> t = creaseCrossing(border, a, b)) {
      const SharedSample middle = shared(border, *t);
      refine(border, a, middle, 0, samples);
      refine(border, middle, b, 0, samples);
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
    samples.front().position = matcher_.corner(leader.start);
    samples.back().position = matcher_.corner(leader.end);
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

  BorderMatcher matcher_;
  const std::vector<Piece>& pieces_;
  const std::vector<SurfaceGrid>& grids_;
  const TessellationOptions& options_;
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
