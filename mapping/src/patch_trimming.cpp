// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "patch_trimming.h"

#include "grid_window.h"
#include "mask_boundary.h"
#include "mask_operations.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

/** Finds the (u, v) of lattice corners. */
class CornerParameters {
public:
  CornerParameters(const ReconstructionInput& input,
                   const FittedSurface& surface,
                   const GridWindow& window)
      : input_(input),
        geometry_(input.points.geometry),
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
    const Eigen::Vector2d uv = surface_.frame.corners == CornerRule::Grid
                                   ? lattice
                                   : fromCells(corner, lattice);
    const NurbsSurface& surface = surface_.fit.surface;
    return {surface.knotsU().clampToDomain(uv.x()),
            surface.knotsV().clampToDomain(uv.y())};
  }

private:
  int
  cellAt(const Eigen::Vector2i& place) const
  {
    return window_.mask.at(place.x(), place.y()) ? position_[window_.index(place)] : -1;
  }

  /** Mean over the nearest member cells around a corner of where each of them has it.
   * Where gaps between samples are closed, these need not be next to the corner. */
  Eigen::Vector2d
  fromCells(const Eigen::Vector2i& corner, const Eigen::Vector2d& lattice) const
  {
    const int farthest = std::max(window_.mask.width, window_.mask.height);
    for (int away = 0; away <= farthest; ++away) {
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      int count = 0;
      for (int dr = -1 - away; dr <= away; ++dr)
        for (int dc = -1 - away; dc <= away; ++dc) {
          const int cell = cellAt(corner + Eigen::Vector2i(dc, dr));
          if (cell < 0)
            continue;
          sum += fromCell(static_cast<std::size_t>(cell), lattice);
          ++count;
        }
      if (count > 0)
        return sum / count;
    }
    throw std::logic_error("trimming: the mask has no member cell");
  }

  /** (u, v) of a lattice position, counted from the point of a cell and not from the
   * cell's centre: a laser's rings are not where one table of angles has them at every
   * range and azimuth, but their spacing is. */
  Eigen::Vector2d
  fromCell(std::size_t k, const Eigen::Vector2d& lattice) const
  {
    Eigen::Vector2d foot = surface_.parameters.col(static_cast<Eigen::Index>(k));
    if (geometry_.projection == GridProjection::lattice)
      return foot;
    const int cell = surface_.cells[k];
    const Eigen::Vector2d centre(window_.origin().x() + window_.place(cell).x(),
                                 cell / geometry_.width);
    const Eigen::Vector2d place = geometry_.chart(input_.position(cell)).head<2>() +
                                  geometry_.chartOfCell(lattice.x(), lattice.y()) -
                                  geometry_.chartOfCell(centre.x(), centre.y());
    if (geometry_.projection == GridProjection::plane)
      return below(place);
    const Eigen::Vector3d ray = geometry_.ray(place.x(), place.y());
    return surface_.frame.corners == CornerRule::View
               ? Eigen::Vector2d(surface_.frame.frame.toLocal(ray).head<2>())
               : onRay(foot, ray);
  }

  /** (u, v) where a ray meets the tangent plane at a foot point; the foot point itself
   * where it grazes the surface. */
  Eigen::Vector2d
  onRay(const Eigen::Vector2d& foot, const Eigen::Vector3d& ray) const
  {
    constexpr double kGrazing = 0.02;
    constexpr double kMostChange = 0.2; // of the range
    const SurfaceJet1 jet = surface_.fit.surface.evaluateJet1(foot.x(), foot.y());
    const Eigen::Vector3d normal = jet.du.cross(jet.dv).normalized();
    const double along = normal.dot(ray);
    if (std::abs(along) < kGrazing)
      return foot;
    const double range = normal.dot(jet.position) / along;
    if (std::abs(range - jet.position.norm()) > kMostChange * jet.position.norm())
      return foot;
    return surface_.frame.frame.toLocal(range * ray).head<2>();
  }

  /** (u, v) of a place in a map, whose rays are all parallel to the heights. */
  Eigen::Vector2d
  below(const Eigen::Vector2d& place) const
  {
    const Eigen::Vector3d chart(place.x(), place.y(), 0.0);
    return surface_.frame.frame.toLocal(geometry_.frame.transpose() * chart).head<2>();
  }

  const ReconstructionInput& input_;
  const GridGeometry& geometry_;
  const FittedSurface& surface_;
  const GridWindow& window_;
  std::vector<int> position_; // in FittedSurface::cells, -1 for none
};

std::vector<TrimLoop>
trimLoops(const ReconstructionInput& input,
          const FittedSurface& surface,
          const GridWindow& window)
{
  const CornerParameters parameters(input, surface, window);
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

/** Whether a patch is where its points are. A surface that cuts across its points (a
 * level plane through a wall) has inliers along a line: the trims around them enclose
 * nothing, or the distances fill the whole range of the tolerance instead of gathering
 * around zero. */
bool
supportsItsPoints(const ReconstructionInput& input,
                  const FittedSurface& surface,
                  const TrimmedPart& part)
{
  constexpr double kFewestInside = 0.5;
  constexpr double kWidestSpread = 4.0 / 9.0; // of the squared tolerance; 1/3: evenly
  double inside = 0.0;
  double spread = 0.0;
  for (std::size_t k : part.members) {
    const auto column = static_cast<Eigen::Index>(k);
    inside += part.patch.geometry.contains(surface.parameters(0, column),
                                           surface.parameters(1, column))
                  ? 1.0
                  : 0.0;
    const double share = surface.distances(column) / input.tolerance(surface.cells[k]);
    spread += share * share;
  }
  const auto count = static_cast<double>(part.members.size());
  return inside >= kFewestInside * count && spread <= kWidestSpread * count;
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
  std::vector<TrimLoop> loops = trimLoops(input, surface, window);
  if (loops.empty())
    return false;
  part.patch.geometry = TrimmedSurface(surface.fit.surface, std::move(loops));
  return supportsItsPoints(input, surface, part);
}

} // namespace nurbs
} // namespace pcl
