// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "kept_edges.h"

#include "grid_steps.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

// A fold between two planes bends the line by up to a few spacings at the fold itself,
// a jump bends it on both of its sides.
constexpr float kOneSidedSpacings = 6.0F;
constexpr float kTwoSidedSpacings = 1.5F;

/** Cells that are looked at in one direction before it is the turn of the next. */
constexpr std::size_t kTogether = 4096;

/** Second differences of depth along the lines of one direction. Holds mere pointers,
 * so that a copy stays in registers while flags are written. */
class JumpTest {
public:
  JumpTest(const GridPoints& points,
           const std::vector<float>& inverse_depth,
           const std::vector<float>& depth_noise,
           const std::vector<float>& direction_noise,
           const GridGraph& graph,
           float sigmas,
           int direction)
      : depth_(points.depth.data()),
        target_(graph.target(direction).data()),
        source_(graph.source(direction).data()),
        inverse_depth_(inverse_depth.empty() ? nullptr : inverse_depth.data()),
        depth_noise_(depth_noise.data()),
        direction_noise_(direction_noise.empty() ? nullptr : direction_noise.data()),
        spacing_(points.geometry, direction),
        sigmas_(sigmas * std::sqrt(6.0F)) // deviation of a second difference
  {
  }

  bool
  operator()(std::size_t i) const
  {
    const auto j = static_cast<std::size_t>(target_[i]);
    const std::size_t near = depth_[j] < depth_[i] ? j : i;
    const float tolerance = sigmas_ * noiseAt(near, directionNoise(i, j));
    const float spacing = spacing_(depth_[near]);
    float least = std::numeric_limits<float>::infinity();
    float most = 0.0F;
    const auto look = [&](std::int32_t before, std::size_t here, std::size_t after) {
      const float bend = bendAt(before, here, after);
      if (bend < 0.0F)
        return;
      least = std::min(least, bend);
      if (isLongerStep(before, here, after))
        most = std::max(most, bend);
    };
    look(source_[i], i, j);
    look(target_[j], j, i);
    return most > kOneSidedSpacings * spacing + tolerance ||
           (std::isfinite(least) && least > kTwoSidedSpacings * spacing + tolerance);
  }

private:
  float
  noiseAt(std::size_t cell, float sideways) const
  {
    const float sigma = depth_noise_[cell];
    return sideways == 0.0F ? sigma : std::sqrt(sigma * sigma + sideways * sideways);
  }

  /** Of the flatter side: beyond a jump the surface may be steep. */
  float
  directionNoise(std::size_t i, std::size_t j) const
  {
    return direction_noise_ == nullptr
               ? 0.0F
               : std::min(direction_noise_[i], direction_noise_[j]);
  }

  /** Whether the depth changes at least as much to the point after as it did from the
   * one before: what jumps is that edge, not the one before. */
  bool
  isLongerStep(std::int32_t before, std::size_t here, std::size_t after) const
  {
    const float last = depth_[here] - depth_[static_cast<std::size_t>(before)];
    return std::abs(depth_[after] - depth_[here]) >= std::abs(last);
  }

  /** How far, in depth, a point is from the line through the two before it; negative
   * when there is no such line. */
  float
  bendAt(std::int32_t before, std::size_t here, std::size_t after) const
  {
    if (before == GridGraph::kNone)
      return -1.0F;
    const auto first = static_cast<std::size_t>(before);
    if (inverse_depth_ == nullptr)
      return std::abs(depth_[first] - 2.0F * depth_[here] + depth_[after]);
    const float bend =
        inverse_depth_[first] - 2.0F * inverse_depth_[here] + inverse_depth_[after];
    return std::abs(bend) * depth_[here] * depth_[after];
  }

  const float* depth_;
  const std::int32_t* target_;
  const std::int32_t* source_;
  const float* inverse_depth_; // none where depth itself is linear
  const float* depth_noise_;
  const float* direction_noise_; // may be none
  GridSpacing spacing_;
  float sigmas_;
};

} // namespace

/** Mark where kept edges begin among some cells.
 * \param[in] jumps whether an edge is over a jump */
template <typename Jumps>
void
KeptEdges::markBegins(std::size_t direction,
                      Jumps jumps,
                      float min_weight,
                      std::size_t first,
                      std::size_t last)
{
  const Lines lines = lines_[direction];
  for (std::size_t i = first; i < last; ++i)
    if (lines.target[i] != GridGraph::kNone && lines.weight[i] >= min_weight &&
        !jumps(i))
      begin_[i] = static_cast<std::uint8_t>(begin_[i] | 1U << direction);
}

/** Mark where kept edges end among some cells. */
void
KeptEdges::markEnds(std::size_t direction, std::size_t first, std::size_t last)
{
  const Lines lines = lines_[direction];
  for (std::size_t i = first; i < last; ++i)
    if (lines.source[i] != GridGraph::kNone &&
        isSet(begin_[static_cast<std::size_t>(lines.source[i])],
              static_cast<int>(direction)))
      end_[i] = static_cast<std::uint8_t>(end_[i] | 1U << direction);
}

KeptEdges::KeptEdges(const GridPoints& points,
                     const GridGraph& graph,
                     const SensorNoise& noise,
                     const ConnectedGroupsOptions& options,
                     const std::vector<float>& direction_noise)
    : graph_(graph), begin_(graph.numCells(), 0), end_(graph.numCells(), 0)
{
  const std::size_t cells = graph.numCells();
  std::vector<float> inverse_depth(isInverseDepthGrid(points.geometry) ? cells : 0);
  std::vector<float> depth_noise(cells);
  std::vector<JumpTest> jumps;
  for (int d = 0; d < graph.numDirections(); ++d) {
    lines_.push_back(
        {graph.target(d).data(), graph.source(d).data(), graph.weight(d).data()});
    jumps.emplace_back(points,
                       inverse_depth,
                       depth_noise,
                       direction_noise,
                       graph,
                       options.jump_sigmas,
                       d);
  }
#pragma omp parallel num_threads(options.threads)
  {
#pragma omp for
    for (std::size_t i = 0; i < cells; ++i) {
      depth_noise[i] = static_cast<float>(noise.sigma(points.depth[i]));
      if (!inverse_depth.empty())
        inverse_depth[i] = 1.0F / points.depth[i];
    }
#pragma omp for
    for (std::size_t first = 0; first < cells; first += kTogether)
      for (std::size_t d = 0; d < lines_.size(); ++d)
        markBegins(
            d, jumps[d], options.min_weight, first, std::min(cells, first + kTogether));
#pragma omp for
    for (std::size_t first = 0; first < cells; first += kTogether)
      for (std::size_t d = 0; d < lines_.size(); ++d)
        markEnds(d, first, std::min(cells, first + kTogether));
  }
}

} // namespace nurbs
} // namespace pcl
