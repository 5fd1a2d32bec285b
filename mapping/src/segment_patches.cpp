// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "segment_patches.h"

#include "mask_operations.h"
#include "patch_trimming.h"

#include <pcl/mapping/stop_watch.h>

#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Turns a segment into patches. */
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
    while (!tasks.empty() && !(input_.options.stop && input_.options.stop())) {
      const Task task = std::move(tasks.back());
      tasks.pop_back();
      CellSet rest = task.cells;
      const bool added = addPatch(task.cells, rest);
      const int depth = task.depth + (added ? 1 : kDepthOfHalves);
      if (depth > kMostDepth || rest.empty())
        continue;
      for (CellSet& part : added
                               ? connectedParts(input_.points.geometry, rest, waiting_)
                               : halves(rest))
        tasks.push_back({std::move(part), depth});
    }
    return std::move(result_);
  }

private:
  static constexpr int kMostDepth = 6;
  static constexpr int kDepthOfHalves = 2; // a third of the attempts: most are in vain

  /** Fit, trim and keep a patch; \a rest is left with the cells it does not explain. */
  bool
  addPatch(const CellSet& cells, CellSet& rest)
  {
    if (static_cast<int>(cells.size()) < input_.options.min_patch_points)
      return false;
    StopWatch watch;
    FittedSurface surface;
    const bool fitted = fitCells(input_, cells, surface);
    result_.fit_seconds += watch.lap();
    if (!fitted)
      return false;
    TrimmedPart part;
    const bool kept = trimToInliers(input_, surface, part);
    if (kept)
      keep(surface, std::move(part), rest);
    result_.trim_seconds += watch.lap();
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

  /** Cells left and right of the middle, or above and below it if that side is longer:
   * what no frame can hold as a whole, such as a room around a laser, may be surfaces
   * in parts. None if the halves would be too small. */
  std::vector<CellSet>
  halves(const CellSet& cells) const
  {
    if (static_cast<int>(cells.size()) < 2 * input_.options.min_patch_points)
      return {};
    const int width = input_.points.geometry.width;
    int low = width;
    int high = 0;
    for (std::int32_t cell : cells) {
      low = std::min(low, cell % width);
      high = std::max(high, cell % width);
    }
    const bool by_column = high - low >= cells.back() / width - cells.front() / width;
    const auto place = [=](std::int32_t cell) {
      return by_column ? cell % width : cell / width;
    };
    std::vector<int> places;
    for (std::int32_t cell : cells)
      places.push_back(place(cell));
    const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
    std::nth_element(places.begin(), middle, places.end());
    std::vector<CellSet> result(2);
    for (std::int32_t cell : cells)
      result[place(cell) < *middle ? 0 : 1].push_back(cell);
    return result;
  }

  const ReconstructionInput& input_;
  SegmentPatches result_;
  std::vector<char> waiting_; // cells of a rest that have no part yet
};

} // namespace

SegmentPatches
patchesOfSegment(const ReconstructionInput& input, CellSet segment)
{
  return SegmentReconstructor(input).run(std::move(segment));
}

} // namespace nurbs
} // namespace pcl
