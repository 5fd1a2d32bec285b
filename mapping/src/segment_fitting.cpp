// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "segment_fitting.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

FitPoints
gather(const ReconstructionInput& input, const CellSet& cells, bool held_out_too)
{
  CellSet chosen;
  for (std::int32_t cell : cells)
    if (held_out_too || !input.held_out[static_cast<std::size_t>(cell)])
      chosen.push_back(cell);
  FitPoints result;
  const auto n = static_cast<Eigen::Index>(chosen.size());
  result.positions.resize(3, n);
  result.sigma.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::int32_t cell = chosen[static_cast<std::size_t>(k)];
    result.positions.col(k) = input.position(cell);
    result.sigma(k) = input.sigma(cell);
  }
  return result;
}

/** Distances of all cells from the fitted surface, and who is within tolerance. */
void
judge(const ReconstructionInput& input, const FitPoints& all, FittedSurface& surface)
{
  const NurbsSurface& fitted = surface.fit.surface;
  surface.parameters.resize(2, all.positions.cols());
  for (Eigen::Index k = 0; k < all.positions.cols(); ++k) {
    const Eigen::Vector3d local = surface.frame.frame.toLocal(all.positions.col(k));
    surface.parameters(0, k) = fitted.knotsU().clampToDomain(local.x());
    surface.parameters(1, k) = fitted.knotsV().clampToDomain(local.y());
  }
  surface.distances = orthogonalDistances(fitted, all.positions, surface.parameters);
  surface.inlier.resize(surface.cells.size());
  surface.num_inliers = 0;
  for (std::size_t k = 0; k < surface.cells.size(); ++k) {
    surface.inlier[k] = std::abs(surface.distances(static_cast<Eigen::Index>(k))) <=
                        input.tolerance(surface.cells[k]);
    surface.num_inliers += surface.inlier[k] ? 1 : 0;
  }
  surface.noise = std::sqrt(all.sigma.squaredNorm() / static_cast<double>(all.sigma.size()));
}

/** Options of the knot search with the correlation of the sensor's noise filled in: a
 * Kinect's disparities are matched over windows, so neighbouring pixels err alike. */
KnotSearchOptions
knotOptions(const ReconstructionInput& input)
{
  constexpr double kCameraCorrelation = 64.0; // pixels
  constexpr double kLaserCorrelation = 4.0;   // samples on a ring
  KnotSearchOptions options = input.options.knots;
  if (options.points_per_sample > 0.0)
    return options;
  const GridProjection projection = input.points.geometry.projection;
  options.points_per_sample = projection == GridProjection::perspective ? kCameraCorrelation
                              : projection == GridProjection::spherical ? kLaserCorrelation
                                                                        : 1.0;
  return options;
}

/** Knot search and fit in one frame; false if the frame does not suit the points. */
bool
fitInFrame(const ReconstructionInput& input,
           const FitPoints& fitted,
           const FitPoints& all,
           FittedSurface& surface)
{
  try {
    FitReport search;
    const auto [knots_u, knots_v] = chooseHeightFieldKnots(
        surface.frame.frame, fitted, knotOptions(input), search);
    surface.fit = fitHeightField(
        surface.frame.frame, knots_u, knots_v, fitted, input.options.fit);
    surface.fit.report.criterion = search.criterion;
    surface.fit.report.salient = std::move(search.salient);
  } catch (const std::domain_error&) {
    return false; // behind the camera, or not determined: another frame may do
  }
  judge(input, all, surface);
  return true;
}

} // namespace

double
ReconstructionInput::sigma(std::int32_t cell) const
{
  return noise.sigma(points.depth[static_cast<std::size_t>(cell)]);
}

double
ReconstructionInput::tolerance(std::int32_t cell) const
{
  return options.tolerance > 0.0 ? options.tolerance
                                 : options.tolerance_sigmas * sigma(cell);
}

bool
fitCells(const ReconstructionInput& input, const CellSet& cells, FittedSurface& surface)
{
  constexpr double kGoodEnough = 0.9;
  const FitPoints fitted = gather(input, cells, false);
  if (fitted.positions.cols() == 0)
    return false;
  const FitPoints all = gather(input, cells, true);
  bool found = false;
  for (FrameCandidate& candidate :
       candidateFrames(input.points.geometry, all.positions)) {
    FittedSurface attempt;
    attempt.frame = std::move(candidate);
    attempt.cells = cells;
    if (!fitInFrame(input, fitted, all, attempt))
      continue;
    if (!found || attempt.num_inliers > surface.num_inliers)
      surface = std::move(attempt);
    found = true;
    if (surface.frame.grid_parameters ||
        static_cast<double>(surface.num_inliers) >=
            kGoodEnough * static_cast<double>(cells.size()))
      break;
  }
  return found;
}

} // namespace nurbs
} // namespace pcl
