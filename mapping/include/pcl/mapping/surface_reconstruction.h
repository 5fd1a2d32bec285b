// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>
#include <pcl/segmentation/grid_points.h>
#include <pcl/segmentation/sensor_noise.h>
#include <pcl/surface/nurbs/fit_options.h>
#include <pcl/surface/nurbs/surface_model.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Options of reconstructSurfaces(). */
struct PCL_NURBS_MAPPING_EXPORT ReconstructionOptions {
  /** Search for degrees and knots; its max_control_points limits each patch, and
   * points_per_sample = 0 stands for what suits the sensor: neighbouring pixels of a
   * depth camera err alike, so 64 of them count as one sample. */
  KnotSearchOptions knots;
  /** Fit of each patch. */
  SurfaceFitOptions fit;
  /** A point belongs to a patch within so many standard deviations of its noise. */
  double tolerance_sigmas = 3.0;
  /** The same as a length for all points (metres); 0 for tolerance_sigmas. */
  double tolerance = 0.0;
  /** Smaller patches are not kept (points). */
  int min_patch_points = 60;
  /** Every so-manieth point is never fitted, only measured; 0 for none. */
  int hold_out_every = 7;
  /** Number of threads; the result does not depend on it. */
  int threads = 1;
  /** Called with the share of points done, 0 to 1, from one thread at a time. */
  std::function<void(double)> progress;
  /** Asked before each fit, from several threads at a time; when it says true, the
   * rest is left out. */
  std::function<bool()> stop;

  /** \brief Defaults that suit a depth camera's or laser's cloud. */
  ReconstructionOptions();
};

/** \brief Patches and how each cell of the grid relates to them. */
struct Reconstruction {
  SurfaceModel model;
  /** Per cell: number of its patch (index + 1), 0 for none. */
  std::vector<std::uint32_t> labels;
  /** Per cell: signed orthogonal distance to its patch (metres), NaN for none. */
  std::vector<float> distances;
  /** Per cell: whether the point was held out of the fits. */
  std::vector<bool> held_out;
  /** Time spent in fits and in trimming, summed over threads (seconds). */
  double fit_seconds = 0.0;
  double trim_seconds = 0.0;
};

/** \brief Turn the segments of an organized cloud into trimmed patches.
 *
 * Each segment gets a projective frame (the sensor's own pixels with inverse depth, or
 * a base plane), in which it is a scalar field; knots are searched, the field is
 * fitted, and the points within tolerance are the patch, whose border in the grid
 * becomes the trimming loops. What is left of the segment is tried again in its
 * connected parts.
 * \param[in] points the cloud
 * \param[in] labels segment of each cell, 0 for none (any numbers)
 * \param[in] noise depth noise of the sensor; at least 1e-5 of the median of the
 * points' largest coordinates is assumed
 * \param[in] options see there
 * \throws std::invalid_argument if sizes do not match or an option is out of range;
 * what \a options.progress or \a options.stop throw comes through
 * \ingroup mapping */
PCL_NURBS_MAPPING_EXPORT Reconstruction
reconstructSurfaces(const GridPoints& points,
                    const std::vector<std::uint32_t>& labels,
                    const SensorNoise& noise,
                    const ReconstructionOptions& options = {});

} // namespace nurbs
} // namespace pcl
