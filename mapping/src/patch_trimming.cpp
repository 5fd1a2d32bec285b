// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "patch_trimming.h"

#include "mask_operations.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Rectangle of the grid around a set of cells; columns may run over the seam of a scan
 * that closes on itself. */
class GridWindow {
public:
  GridWindow(const GridGeometry& geometry, const CellSet& cells) : geometry_(geometry)
  {
    std::vector<char> used(static_cast<std::size_t>(geometry.width), 0);
    int row_low = geometry.height;
    int row_high = 0;
    for (std::int32_t cell : cells) {
      used[static_cast<std::size_t>(cell % geometry.width)] = 1;
      row_low = std::min(row_low, cell / geometry.width);
      row_high = std::max(row_high, cell / geometry.width);
    }
    first_row_ = row_low;
    mask.height = row_high - row_low + 1;
    chooseColumns(used);
    mask.cells.assign(static_cast<std::size_t>(mask.width) *
                          static_cast<std::size_t>(mask.height),
                      0);
  }

  /** Column and row of a cell within the window. */
  Eigen::Vector2i
  place(std::int32_t cell) const
  {
    const int column =
        (cell % geometry_.width - first_column_ + geometry_.width) % geometry_.width;
    return {column, cell / geometry_.width - first_row_};
  }

  std::size_t
  index(const Eigen::Vector2i& place) const
  {
    return static_cast<std::size_t>(place.y()) * static_cast<std::size_t>(mask.width) +
           static_cast<std::size_t>(place.x());
  }

  Eigen::Vector2d
  origin() const
  {
    return {first_column_, first_row_};
  }

  CellMask mask;

private:
  /** Start after the widest run of unused columns, counted around a closed scan. */
  void
  chooseColumns(const std::vector<char>& used)
  {
    const int width = geometry_.width;
    int best_length = -1;
    int best_end = 0;
    const int turns = geometry_.wrap ? 2 : 1;
    int length = 0;
    for (int k = 0; k < turns * width && geometry_.wrap; ++k) {
      length = used[static_cast<std::size_t>(k % width)] != 0 ? 0 : length + 1;
      if (length > best_length && length <= width) {
        best_length = length;
        best_end = (k + 1) % width;
      }
    }
    if (geometry_.wrap && best_length > 0) {
      first_column_ = best_end;
      mask.width = width - best_length;
      return;
    }
    const auto first = std::find(used.begin(), used.end(), 1);
    const auto last = std::find(used.rbegin(), used.rend(), 1);
    first_column_ = static_cast<int>(first - used.begin());
    mask.width = static_cast<int>(used.rend() - last) - first_column_;
  }

  const GridGeometry& geometry_;
  int first_column_ = 0;
  int first_row_ = 0;
};

/** Finds the (u, v) of lattice corners. */
class CornerParameters {
public:
  CornerParameters(const GridGeometry& geometry,
                   const FittedSurface& surface,
                   const GridWindow& window)
      : geometry_(geometry),
        surface_(surface),
        window_(window),
        position_(window.mask.cells.size(), -1)
  {
    for (std::size_t k = 0; k < surface.cells.size(); ++k)
      if (surface.inlier[k])
        position_[window.index(window.place(surface.cells[k]))] = static_cast<int>(k);
  }

  Eigen::Vector2d
  at(const Eigen::Vector2i& corner) const
  {
    const Eigen::Vector2d lattice =
        corner.cast<double>() + window_.origin() - Eigen::Vector2d(0.5, 0.5);
    const Eigen::Vector2d uv = uvOf(corner, lattice);
    const NurbsSurface& surface = surface_.fit.surface;
    return {surface.knotsU().clampToDomain(uv.x()),
            surface.knotsV().clampToDomain(uv.y())};
  }

private:
  Eigen::Vector2d
  uvOf(const Eigen::Vector2i& corner, const Eigen::Vector2d& lattice) const
  {
    switch (surface_.frame.corners) {
    case CornerRule::Grid:
      return lattice;
    case CornerRule::View:
      return surface_.frame.frame.toLocal(geometry_.direction(lattice.x(), lattice.y()))
          .head<2>();
    case CornerRule::Surface:
      break;
    }
    return fromCells(corner, lattice);
  }

  int
  cellAt(const Eigen::Vector2i& place) const
  {
    return window_.mask.at(place.x(), place.y()) ? position_[window_.index(place)] : -1;
  }

  /** Mean over the member cells around a corner of where the ray through the corner
   * meets the tangent plane of the surface at each of them. */
  Eigen::Vector2d
  fromCells(const Eigen::Vector2i& corner, const Eigen::Vector2d& lattice) const
  {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    int count = 0;
    for (int dr : {-1, 0})
      for (int dc : {-1, 0}) {
        const int cell = cellAt(corner + Eigen::Vector2i(dc, dr));
        if (cell < 0)
          continue;
        sum += onRay(surface_.parameters.col(cell), lattice);
        ++count;
      }
    return count > 0 ? Eigen::Vector2d(sum / count) : sum;
  }

  /** (u, v) where the ray through a lattice position meets the tangent plane at a foot
   * point; the foot point itself where there are no rays, or they graze the surface. */
  Eigen::Vector2d
  onRay(const Eigen::Vector2d& foot, const Eigen::Vector2d& lattice) const
  {
    constexpr double kGrazing = 0.02;
    constexpr double kMostChange = 0.2; // of the range
    if (geometry_.projection != GridProjection::perspective &&
        geometry_.projection != GridProjection::spherical)
      return foot;
    const SurfaceJet1 jet = surface_.fit.surface.evaluateJet1(foot.x(), foot.y());
    const Eigen::Vector3d normal = jet.du.cross(jet.dv).normalized();
    const Eigen::Vector3d ray = geometry_.direction(lattice.x(), lattice.y());
    const double along = normal.dot(ray);
    if (std::abs(along) < kGrazing)
      return foot;
    const double range = normal.dot(jet.position) / along;
    if (std::abs(range - jet.position.norm()) > kMostChange * jet.position.norm())
      return foot;
    return surface_.frame.frame.toLocal(range * ray).head<2>();
  }

  const GridGeometry& geometry_;
  const FittedSurface& surface_;
  const GridWindow& window_;
  std::vector<int> position_; // in FittedSurface::cells, -1 for none
};

std::vector<TrimLoop>
trimLoops(const GridGeometry& geometry,
          const FittedSurface& surface,
          const GridWindow& window)
{
  const CornerParameters parameters(geometry, surface, window);
  // Rows count downwards: seen in (u, v) the sense of a loop may be the other one.
  std::vector<TrimLoop> loops;
  double total = 0.0;
  for (const LatticeLoop& loop : traceBoundary(window.mask)) {
    std::vector<Eigen::Vector2d> corners;
    for (const Eigen::Vector2i& corner : loop) {
      const Eigen::Vector2d uv = parameters.at(corner);
      if (corners.empty() || uv != corners.back())
        corners.push_back(uv);
    }
    if (corners.size() > 1 && corners.front() == corners.back())
      corners.pop_back();
    if (corners.size() < 3)
      continue;
    loops.push_back(TrimLoop::polygon(corners));
    total += loops.back().signedArea();
  }
  if (total < 0.0)
    for (TrimLoop& loop : loops)
      loop = loop.reversed();
  return loops;
}

} // namespace

bool
trimToInliers(const ReconstructionInput& input,
              const FittedSurface& surface,
              TrimmedPart& part)
{
  GridWindow window(input.points.geometry, surface.cells);
  for (std::size_t k = 0; k < surface.cells.size(); ++k)
    if (surface.inlier[k])
      window.mask.cells[window.index(window.place(surface.cells[k]))] = 1;
  const CellMask inliers = window.mask;
  window.mask = closed(inliers, input.points.geometry.max_gap);
  clearSmallParts(window.mask, inliers, input.options.min_patch_points);

  PatchQuality& quality = part.patch.quality;
  double sum = 0.0;
  for (std::size_t k = 0; k < surface.cells.size(); ++k) {
    if (!surface.inlier[k] ||
        window.mask.cells[window.index(window.place(surface.cells[k]))] == 0)
      continue;
    const double distance = std::abs(surface.distances(static_cast<Eigen::Index>(k)));
    part.members.push_back(k);
    sum += distance * distance;
    quality.max = std::max(quality.max, distance);
  }
  if (static_cast<int>(part.members.size()) < input.options.min_patch_points)
    return false;
  quality.points = part.members.size();
  quality.noise = surface.noise;
  quality.rmse = std::sqrt(sum / static_cast<double>(part.members.size()));
  std::vector<TrimLoop> loops = trimLoops(input.points.geometry, surface, window);
  if (loops.empty())
    return false;
  part.patch.geometry = TrimmedSurface(surface.fit.surface, std::move(loops));
  return true;
}

} // namespace nurbs
} // namespace pcl
