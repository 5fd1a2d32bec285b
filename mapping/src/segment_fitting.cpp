// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "segment_fitting.h"

#include <Eigen/Eigenvalues>

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

/** The points inside of a slab. */
FitPoints
inside(const Slab& slab, const FitPoints& points)
{
  FitPoints result = points;
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k < points.positions.cols(); ++k)
    if (slab.contains(points.positions.col(k))) {
      result.positions.col(count) = points.positions.col(k);
      result.sigma(count++) = points.sigma(k);
    }
  result.positions.conservativeResize(Eigen::NoChange, count);
  result.sigma.conservativeResize(count);
  return result;
}

/** Signed distances from a fitted surface and the foot points. */
Eigen::VectorXd
distancesFrom(const FittedSurface& surface,
              const Eigen::Matrix3Xd& positions,
              Eigen::Matrix2Xd& parameters)
{
  constexpr double kLastStep = 1e-4; // off by far less than any noise
  const NurbsSurface& fitted = surface.fit.surface;
  parameters.resize(2, positions.cols());
  for (Eigen::Index k = 0; k < positions.cols(); ++k) {
    const Eigen::Vector3d local = surface.frame.frame.toLocal(positions.col(k));
    parameters(0, k) = fitted.knotsU().clampToDomain(local.x());
    parameters(1, k) = fitted.knotsV().clampToDomain(local.y());
  }
  return orthogonalDistances(fitted, positions, parameters, 1, kLastStep);
}

/** About how many points are within tolerance, by a sample of them. */
double
countInliers(const ReconstructionInput& input,
             const FitPoints& points,
             const FittedSurface& surface)
{
  constexpr Eigen::Index kSample = 2048;
  const Eigen::Index every = points.positions.cols() / kSample + 1;
  const Eigen::Index count = (points.positions.cols() + every - 1) / every;
  Eigen::Matrix3Xd positions(3, count);
  for (Eigen::Index k = 0; k < count; ++k)
    positions.col(k) = points.positions.col(k * every);
  Eigen::Matrix2Xd parameters;
  const Eigen::VectorXd distances = distancesFrom(surface, positions, parameters);
  Eigen::Index inliers = 0;
  for (Eigen::Index k = 0; k < count; ++k)
    inliers +=
        std::abs(distances(k)) <= input.toleranceAt(points.sigma(k * every)) ? 1 : 0;
  return static_cast<double>(inliers) / static_cast<double>(count) *
         static_cast<double>(points.positions.cols());
}

/** Distances of all cells from the fitted surface, and who is within tolerance. */
void
judge(const ReconstructionInput& input, const FitPoints& all, FittedSurface& surface)
{
  surface.distances = distancesFrom(surface, all.positions, surface.parameters);
  surface.inlier.resize(surface.cells.size());
  for (std::size_t k = 0; k < surface.cells.size(); ++k)
    surface.inlier[k] = std::abs(surface.distances(static_cast<Eigen::Index>(k))) <=
                        input.tolerance(surface.cells[k]);
}

/** How many neighbouring points err alike, at first: a Kinect's disparities are matched
 * over windows, so its pixels do. */
double
typicalCorrelation(GridProjection projection)
{
  constexpr double kCamera = 64.0; // pixels
  constexpr double kLaser = 4.0;   // samples on a ring
  switch (projection) {
  case GridProjection::perspective:
    return kCamera;
  case GridProjection::spherical:
    return kLaser;
  default:
    return 1.0;
  }
}

/** Fit with given knots. Control points beyond the points' border may be pulled behind
 * the camera by noise; the gentlest stiffness that keeps them in front is used.
 * \throws std::domain_error if none does */
SurfaceFit
fitInFront(const HeightFieldFrame& frame,
           const SurfaceKnots& knots,
           const FitPoints& points,
           SurfaceFitOptions options)
{
  constexpr double kStiffest = 1e-4;
  options.measure = false; // judge() does, and the held-out points as well
  while (true) {
    try {
      return fitHeightField(frame, knots.first, knots.second, points, options);
    } catch (const std::domain_error&) {
      if (options.fairness >= kStiffest)
        throw;
      options.fairness = std::max(1e-9, 100.0 * options.fairness);
    }
  }
}

/** Knot search and fit in one frame with an assumed correlation; false if the frame
 * does not suit the points, or if the knots are those of the coarser fit. */
bool
fitOnce(const ReconstructionInput& input,
        const FitPoints& fitted,
        const FitPoints& judged,
        const KnotSearchOptions& options,
        const FittedSurface* coarser,
        FittedSurface& surface)
{
  try {
    FitReport search;
    surface.knots =
        chooseHeightFieldKnots(surface.frame.frame,
                               fitted,
                               options,
                               search,
                               coarser != nullptr ? &coarser->knots : nullptr);
    if (coarser != nullptr && surface.knots == coarser->knots)
      return false;
    surface.fit =
        fitInFront(surface.frame.frame, surface.knots, fitted, input.options.fit);
    surface.fit.report.criterion = search.criterion;
    surface.fit.report.salient = std::move(search.salient);
  } catch (const std::domain_error&) {
    return false; // behind the camera, or not determined: another frame may do
  }
  surface.num_inliers = countInliers(input, judged, surface);
  return true;
}

/** Fit in one frame. Residuals may be correlated noise, but not beyond what the
 * sensor's noise allows: where they are, less correlation is assumed, which admits
 * finer knots. */
bool
fitInFrame(const ReconstructionInput& input,
           const FitPoints& fitted,
           const FitPoints& judged,
           FittedSurface& surface)
{
  constexpr double kExplained = 0.97;
  constexpr double kWorthwhile = 0.01;
  KnotSearchOptions options = input.options.knots;
  const bool automatic = options.points_per_sample == 0.0;
  if (automatic)
    options.points_per_sample = typicalCorrelation(input.points.geometry.projection);
  if (!fitOnce(input, fitted, judged, options, nullptr, surface))
    return false;
  const double count = static_cast<double>(fitted.sigma.size());
  // Beyond the limit of samples less correlation would change nothing.
  while (automatic && options.points_per_sample > 1.0 &&
         count / options.points_per_sample < options.max_samples &&
         surface.num_inliers < kExplained * count) {
    options.points_per_sample = std::max(1.0, 0.25 * options.points_per_sample);
    FittedSurface finer;
    finer.frame = surface.frame;
    finer.cells = surface.cells;
    if (!fitOnce(input, fitted, judged, options, &surface, finer) ||
        finer.num_inliers < surface.num_inliers + kWorthwhile * count)
      break;
    surface = std::move(finer);
  }
  return true;
}

/** Whether points lie along a line up to their noise: any surface through it fits. */
bool
areALine(const FitPoints& points)
{
  const Eigen::Vector3d mean = points.positions.rowwise().mean();
  const Eigen::Matrix3Xd centred = points.positions.colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      centred * centred.transpose(), Eigen::EigenvaluesOnly);
  return !(solver.eigenvalues()(1) > points.sigma.squaredNorm());
}

} // namespace

double
ReconstructionInput::sigma(std::int32_t cell) const
{
  const double depth = points.depth[static_cast<std::size_t>(cell)];
  return std::max(noise.sigma(depth), least_sigma);
}

double
ReconstructionInput::toleranceAt(double sigma) const
{
  return options.tolerance > 0.0 ? options.tolerance : options.tolerance_sigmas * sigma;
}

bool
fitCells(const ReconstructionInput& input, const CellSet& cells, FittedSurface& surface)
{
  constexpr double kGoodEnough = 0.9;
  const FitPoints fitted = gather(input, cells, false);
  if (fitted.positions.cols() == 0 || areALine(fitted))
    return false;
  bool found = false;
  bool seen = false; // by a camera
  for (const FrameProposal& proposal :
       proposeFrames(input.points.geometry, fitted.positions, fitted.sigma.mean())) {
    const bool view = proposal.corners != CornerRule::Surface;
    if (found && seen && !view)
      break; // a camera's base planes are for what its own view cannot hold
    seen = seen || proposal.corners == CornerRule::Grid;
    std::optional<FrameCandidate> candidate = proposal.find();
    if (!candidate)
      continue;
    FittedSurface attempt;
    attempt.frame = std::move(*candidate);
    attempt.cells = cells;
    const std::optional<Slab>& slab = attempt.frame.slab;
    if (!fitInFrame(input, slab ? inside(*slab, fitted) : fitted, fitted, attempt))
      continue;
    if (!found || attempt.num_inliers > surface.num_inliers)
      surface = std::move(attempt);
    found = true;
    if (surface.num_inliers >= kGoodEnough * static_cast<double>(fitted.sigma.size()))
      break;
  }
  if (!found)
    return false;
  judge(input, gather(input, cells, true), surface);
  surface.noise =
      std::sqrt(fitted.sigma.squaredNorm() / static_cast<double>(fitted.sigma.size()));
  return true;
}

} // namespace nurbs
} // namespace pcl
