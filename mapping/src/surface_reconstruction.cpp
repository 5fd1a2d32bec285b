// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/surface_reconstruction.h>

#include "segment_patches.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

void
requireValid(const GridPoints& points,
             const std::vector<std::uint32_t>& labels,
             const ReconstructionOptions& options)
{
  if (labels.size() != points.size())
    throw std::invalid_argument("reconstruction: one label per cell is needed");
  const KnotSearchOptions& knots = options.knots;
  if (!(options.tolerance_sigmas > 0.0) || !(options.tolerance >= 0.0) ||
      options.min_patch_points < 4 || options.threads < 1 ||
      options.hold_out_every < 0 || options.hold_out_every == 1 ||
      knots.max_degree < 1 || knots.max_degree > kMaxDegree ||
      knots.max_control_points < 4 ||
      !(knots.points_per_sample == 0.0 || knots.points_per_sample >= 1.0))
    throw std::invalid_argument("reconstruction: an option is out of range");
}

/** Cells of each segment by increasing label; labels may be any numbers. */
std::map<std::uint32_t, CellSet>
cellsByLabel(const GridPoints& points, const std::vector<std::uint32_t>& labels)
{
  std::map<std::uint32_t, CellSet> result;
  auto last = result.end(); // neighbours mostly have the same label
  for (std::size_t cell = 0; cell < labels.size(); ++cell) {
    if (labels[cell] == 0 || !points.valid(cell))
      continue;
    if (last == result.end() || last->first != labels[cell])
      last = result.try_emplace(labels[cell]).first;
    last->second.push_back(static_cast<std::int32_t>(cell));
  }
  return result;
}

std::vector<bool>
chooseHeldOut(const GridPoints& points, int every)
{
  std::vector<bool> result(points.size(), false);
  int count = 0;
  for (std::size_t cell = 0; cell < points.size(); ++cell)
    if (points.valid(cell) && every > 0)
      result[cell] = ++count % every == 0;
  return result;
}

/** Noise that even exact points are granted: what a surface of a moderate number of
 * control points can follow. The median, as single coordinates may be wild; of a
 * sample. */
double
leastNoise(const GridPoints& points)
{
  constexpr double kShare = 1e-5;
  constexpr std::size_t kSample = 20000;
  const std::size_t stride = points.size() / kSample + 1;
  std::vector<float> sizes;
  std::size_t valid = 0;
  for (std::size_t cell = 0; cell < points.size(); ++cell)
    if (points.valid(cell) && valid++ % stride == 0)
      sizes.push_back(points.point(cell).lpNorm<Eigen::Infinity>());
  if (sizes.empty())
    return 0.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return kShare * static_cast<double>(*middle);
}

void
append(SegmentPatches segment, Reconstruction& result)
{
  for (std::size_t k = 0; k < segment.patches.size(); ++k) {
    segment.patches[k].label = segment.label;
    result.model.patches.push_back(std::move(segment.patches[k]));
    const auto number = static_cast<std::uint32_t>(result.model.patches.size());
    for (std::size_t i = 0; i < segment.cells[k].size(); ++i) {
      const auto cell = static_cast<std::size_t>(segment.cells[k][i]);
      result.labels[cell] = number;
      result.distances[cell] = segment.distances[k][i];
    }
  }
  result.fit_seconds += segment.fit_seconds;
  result.trim_seconds += segment.trim_seconds;
}

/** Segments by decreasing size: a large one that comes last would keep one thread busy
 * after the others are done. */
std::vector<std::size_t>
largestFirst(const std::vector<CellSet>& segments)
{
  std::vector<std::size_t> order(segments.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return segments[a].size() > segments[b].size();
  });
  return order;
}

/** Shares segments out to threads and tells how many points are done. */
class ParallelReconstruction {
public:
  explicit ParallelReconstruction(const ReconstructionInput& input) : input_(input) {}

  /** What was thrown for a segment is thrown again once all threads are done: no
   * exception may leave a parallel region. */
  std::vector<SegmentPatches>
  run(std::map<std::uint32_t, CellSet> by_label)
  {
    std::vector<SegmentPatches> found(by_label.size());
    std::vector<CellSet> segments;
    for (auto& [label, cells] : by_label) {
      found[segments.size()].label = label;
      total_ += cells.size();
      segments.push_back(std::move(cells));
    }
    const std::vector<std::size_t> order = largestFirst(segments);
#pragma omp parallel for schedule(dynamic, 1) num_threads(input_.options.threads)
    for (std::size_t turn = 0; turn < order.size(); ++turn) {
      const std::size_t k = order[turn];
      try {
        reconstruct(std::move(segments[k]), found[k]);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        failure_ = std::current_exception();
      }
    }
    if (failure_)
      std::rethrow_exception(failure_);
    return found;
  }

private:
  void
  reconstruct(CellSet cells, SegmentPatches& found)
  {
    if (failed() || (input_.options.stop && input_.options.stop()))
      return;
    const std::size_t size = cells.size();
    const std::uint32_t label = found.label;
    found = patchesOfSegment(input_, std::move(cells));
    found.label = label;
    const std::lock_guard<std::mutex> lock(mutex_);
    done_ += size;
    if (input_.options.progress)
      input_.options.progress(static_cast<double>(done_) / static_cast<double>(total_));
  }

  bool
  failed()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return failure_ != nullptr;
  }

  const ReconstructionInput& input_;
  std::size_t total_ = 0;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
  std::mutex mutex_; // for done_, failure_ and the progress call
};

} // namespace

ReconstructionOptions::ReconstructionOptions()
{
  knots.max_control_points = 400;
  knots.points_per_sample = 0.0;
  fit.distance = FitDistance::Parametric;
  fit.loss = RobustLoss::Huber;
  fit.linear_solver = LinearSolver::Cholesky; // many small fits; the same result
}

Reconstruction
reconstructSurfaces(const GridPoints& points,
                    const std::vector<std::uint32_t>& labels,
                    const SensorNoise& noise,
                    const ReconstructionOptions& options)
{
  requireValid(points, labels, options);
  Reconstruction result;
  result.labels.assign(points.size(), 0);
  result.distances.assign(points.size(), std::numeric_limits<float>::quiet_NaN());
  result.held_out = chooseHeldOut(points, options.hold_out_every);
  const ReconstructionInput input{
      points, noise, options, result.held_out, leastNoise(points)};

  std::vector<SegmentPatches> found =
      ParallelReconstruction(input).run(cellsByLabel(points, labels));
  for (SegmentPatches& segment : found)
    append(std::move(segment), result);
  return result;
}

} // namespace nurbs
} // namespace pcl
