// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "patch_frames.h"

#include <pcl/mapping/surface_reconstruction.h>
#include <pcl/surface/nurbs/surface_fitter.h>

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Cells of a grid that may be one surface. */
using CellSet = std::vector<std::int32_t>;

/** \brief A surface fitted to a set of cells. */
struct FittedSurface {
  SurfaceFit fit;
  SurfaceKnots knots;
  FrameCandidate frame;
  CellSet cells;               /**< all cells that were looked at */
  Eigen::Matrix2Xd parameters; /**< foot point of each of them */
  Eigen::VectorXd distances;   /**< signed orthogonal distance of each, metres */
  std::vector<bool> inlier;    /**< whether each is within tolerance */
  double noise = 0.0;          /**< root mean square of the sensor's noise, metres */
  double num_inliers = 0.0;    /**< about, of the cells that are not held out */
};

/** \brief What every fit of a reconstruction needs. */
struct ReconstructionInput {
  const GridPoints& points;
  const SensorNoise& noise;
  const ReconstructionOptions& options;
  const std::vector<bool>& held_out; /**< per cell */
  double least_sigma;                /**< no noise is smaller, metres */

  Eigen::Vector3d
  position(std::int32_t cell) const
  {
    return points.point(static_cast<std::size_t>(cell)).cast<double>();
  }

  /** \brief Standard deviation along the ray, metres. */
  double
  sigma(std::int32_t cell) const;

  /** \brief Largest distance from its patch of a point whose noise has this standard
   * deviation, metres. */
  double
  toleranceAt(double sigma) const;

  /** \brief The same of a cell's point. */
  double
  tolerance(std::int32_t cell) const
  {
    return toleranceAt(sigma(cell));
  }
};

/** \brief Fit one surface to a set of cells, in the frame that explains most of them.
 * \param[in] input the cloud
 * \param[in] cells at least one cell that is not held out
 * \param[out] surface the fit
 * \return false if the cells are a mere line or no frame gave a surface */
bool
fitCells(const ReconstructionInput& input,
         const CellSet& cells,
         FittedSurface& surface);

} // namespace nurbs
} // namespace pcl
