// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/mapping/surface_reconstruction.h>

#include "mask_operations.h"
#include "patch_trimming.h"
#include "segment_fitting.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

using Clock = std::chrono::steady_clock;

double
secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/** All patches of one segment, in the order they were found. */
struct SegmentPatches {
  std::vector<SurfacePatch> patches;
  std::vector<CellSet> cells;
  std::vector<std::vector<float>> distances;
  double fit_seconds = 0.0;
  double trim_seconds = 0.0;
};

/** Turns one segment after the other into patches. */
class SegmentReconstructor {
public:
  explicit SegmentReconstructor(const ReconstructionInput& input) : input_(input) {}

  SegmentPatches
  run(CellSet segment)
  {
    struct Task {
      CellSet cells;
      int depth;
    };
    std::vector<Task> tasks;
    tasks.push_back({std::move(segment), 0});
    while (!tasks.empty()) {
      const Task task = std::move(tasks.back());
      tasks.pop_back();
      CellSet rest = task.cells;
      if (addPatch(task.cells, rest) && task.depth < kMostDepth)
        for (CellSet& part : connectedParts(input_.points.geometry, rest, waiting_))
          tasks.push_back({std::move(part), task.depth + 1});
    }
    return std::move(result_);
  }

private:
  static constexpr int kMostDepth = 6;

  /** Fit, trim and keep a patch; \a rest is left with the cells it does not explain. A
   * segment that is more than one smooth surface is cut in two instead. */
  bool
  addPatch(const CellSet& cells, CellSet& rest)
  {
    if (static_cast<int>(cells.size()) < input_.options.min_patch_points)
      return false;
    const Clock::time_point start = Clock::now();
    FittedSurface surface;
    const bool fitted = fitCells(input_, cells, surface);
    result_.fit_seconds += secondsSince(start);
    if (!fitted)
      return false;
    const Clock::time_point trim_start = Clock::now();
    TrimmedPart part;
    const bool kept = trimToInliers(input_, surface, part);
    if (kept)
      keep(surface, std::move(part), rest);
    result_.trim_seconds += secondsSince(trim_start);
    return kept;
  }

  void
  keep(const FittedSurface& surface, TrimmedPart part, CellSet& rest)
  {
    std::vector<bool> member(surface.cells.size(), false);
    CellSet cells;
    std::vector<float> distances;
    for (std::size_t k : part.members) {
      member[k] = true;
      cells.push_back(surface.cells[k]);
      distances.push_back(
          static_cast<float>(surface.distances(static_cast<Eigen::Index>(k))));
    }
    rest.clear();
    for (std::size_t k = 0; k < surface.cells.size(); ++k)
      if (!member[k])
        rest.push_back(surface.cells[k]);
    result_.patches.push_back(std::move(part.patch));
    result_.cells.push_back(std::move(cells));
    result_.distances.push_back(std::move(distances));
  }

  const ReconstructionInput& input_;
  SegmentPatches result_;
  std::vector<char> waiting_; // cells of a rest that have no part yet
};

void
requireValid(const GridPoints& points,
             const std::vector<std::uint32_t>& labels,
             const ReconstructionOptions& options)
{
  if (labels.size() != points.size())
    throw std::invalid_argument("reconstruction: one label per cell is needed");
  if (!(options.tolerance_sigmas > 0.0) || !(options.tolerance >= 0.0) ||
      options.min_patch_points < 4 || options.threads < 1 ||
      options.hold_out_every < 0 || options.hold_out_every == 1)
    throw std::invalid_argument("reconstruction: an option is out of range");
}

/** Cells of each segment; the first one is label 1. */
std::vector<CellSet>
cellsByLabel(const GridPoints& points, const std::vector<std::uint32_t>& labels)
{
  std::vector<CellSet> result;
  for (std::size_t cell = 0; cell < labels.size(); ++cell) {
    if (labels[cell] == 0 || !points.valid(cell))
      continue;
    if (labels[cell] > result.size())
      result.resize(labels[cell]);
    result[labels[cell] - 1].push_back(static_cast<std::int32_t>(cell));
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

void
append(SegmentPatches segment, std::uint32_t label, Reconstruction& result)
{
  for (std::size_t k = 0; k < segment.patches.size(); ++k) {
    segment.patches[k].label = label;
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

} // namespace

ReconstructionOptions::ReconstructionOptions()
{
  knots.max_control_points = 400;
  knots.points_per_sample = 0.0;
  fit.distance = FitDistance::Parametric;
  fit.loss = RobustLoss::Huber;
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
  const ReconstructionInput input{points, noise, options, result.held_out};

  std::vector<CellSet> segments = cellsByLabel(points, labels);
  std::size_t total = 0;
  for (const CellSet& segment : segments)
    total += segment.size();
  std::vector<SegmentPatches> found(segments.size());
  std::size_t done = 0;
#pragma omp parallel for schedule(dynamic, 1) num_threads(options.threads)
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const std::size_t size = segments[k].size();
    if (options.stop && options.stop())
      continue;
    found[k] = SegmentReconstructor(input).run(std::move(segments[k]));
#pragma omp critical(pcl_nurbs_reconstruction_progress)
    {
      done += size;
      if (options.progress)
        options.progress(static_cast<double>(done) / static_cast<double>(total));
    }
  }
  for (std::size_t k = 0; k < found.size(); ++k)
    append(std::move(found[k]), static_cast<std::uint32_t>(k + 1), result);
  return result;
}

} // namespace nurbs
} // namespace pcl
