// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/rigid_motion.h>
#include <pcl/registration/robust_kernel.h>
#include <pcl/registration/voxel_map.h>

namespace pcl {
namespace nurbs {

/** \brief What is made small between a scan and its target.
 * \ingroup registration */
enum class MatchMetric {
  /** Distance to the nearest point (Besl & McKay, PAMI 1992). */
  PointToPoint,
  /** Distance to the local plane (Chen & Medioni, IVC 1992) where there is one, to the
   * nearest point elsewhere. */
  PointToPlane,
  /** Generalized ICP (Segal et al., RSS 2009), local planes on both sides. */
  PlaneToPlane
};

/** \brief Parameters of matchScan(). */
struct MatchOptions {
  MatchMetric metric = MatchMetric::PointToPlane;
  RobustKernel kernel;
  /** Farther pairs are none, metres. */
  double max_distance = 1.0;
  int max_iterations = 80;
  /** A step below both ends the iteration: metres, radians. */
  double translation_epsilon = 2e-4;
  double rotation_epsilon = 2e-5;
  /** Weight of pairs without a plane in PointToPlane, 0 to leave them out. */
  double scatter_weight = 0.3;
  /** A direction is supported when the mean square by which a motion along it moves
   * the points off their surfaces, relative to the motion's own, is more than this. */
  double min_support = 1e-3;
  /** The result does not depend on it. */
  int threads = 1;
};

/** \brief How well the surroundings hold a pose in each direction.
 *
 * Rotations count as the way that a point at \a scale makes. */
struct Degeneracy {
  /** Unit tangents by columns, (translation, rotation * scale), by rising support. */
  TangentMatrix directions = TangentMatrix::Identity();
  /** 0: nothing stops a motion in this direction; 1: all points do. */
  Tangent support = Tangent::Zero();
  /** Root mean square distance of the points from the sensor, metres. */
  double scale = 1.0;
  /** Number of leading directions below MatchOptions::min_support. */
  int unsupported = 6;
};

/** \brief Where a scan lies. */
struct MatchResult {
  /** From the scan's frame to the target's. */
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  bool converged = false;
  int iterations = 0;
  /** Points of the scan that have a counterpart at the pose. */
  std::size_t correspondences = 0;
  /** Share of the scan's points that lie on the target's surface at the pose, within a
   * fifth of a voxel. A scan that is where it belongs has most of its points there but
   * for those that look at new places; one that is not, few. */
  double inlier_share = 0.0;
  /** The same within a voxel of the target's points: the part of the scan that looks at
   * known places, if the pose is right. */
  double near_share = 0.0;
  /** Weighted root mean square residual, metres. */
  double rmse = 0.0;
  /** Of the pose, as Tangent says; unsupported directions have a variance of
   * kUnsupportedVariance. */
  TangentMatrix covariance = TangentMatrix::Zero();
  /** Its inverse, with zeros in unsupported directions. */
  TangentMatrix information = TangentMatrix::Zero();
  Degeneracy degeneracy;

  /** \brief Share of the scan on the target; less, where other points are near it but
   * not on it. Tells the better of two alignments of a scan. */
  double
  fit() const
  {
    return near_share > 0.0 ? inlier_share * inlier_share / near_share : 0.0;
  }
};

/** \brief Stands for "not known": 100 m, or 100 m at the mean distance of the points.
 */
constexpr double kUnsupportedVariance = 1e4;

/** \brief Align a scan with a map, from an initial guess.
 *
 * Gauss-Newton on SE(3) with right perturbations (see Tangent); pairs are found anew
 * where a point has moved. Directions without support keep their initial value.
 *
 * The covariance is the "sandwich" one: the scatter of the loss's gradient between the
 * inverses of its slope. Neighbouring points share the errors of a plane, so products
 * of gradients count with Bartlett's weights within four voxels (Conley, J.
 * Econometrics 92, 1999). Nearest points go along with a motion on their surface, so
 * that the slope is not Gauss and Newton's matrix: it is taken from differences, with
 * pairs found anew. It is that of the gradient's root; an iteration that ends early
 * keeps something of its guess, of which it knows nothing. Sums are taken in fixed
 * chunks: same bits for any number of threads.
 *
 * \param[in] map target
 * \param[in] scan finite points
 * \param[in] normals of the scan in PlaneToPlane, zero where there is none; else unused
 * \param[in] guess initial pose, finite
 * \return the pose; not converged with fewer than six pairs
 * \throws std::invalid_argument for a guess that is not finite, or with a number of
 * normals that does not fit. O(iterations * points) */
PCL_NURBS_REGISTRATION_EXPORT MatchResult
matchScan(const VoxelMap& map,
          const ScanPoints& scan,
          const ScanPoints& normals,
          const Eigen::Isometry3d& guess,
          const MatchOptions& options);

/** \brief Normals of the local surfaces of a map at given points, zero where it is not
 * flat: the source's side of PlaneToPlane. */
PCL_NURBS_REGISTRATION_EXPORT ScanPoints
surfaceNormals(const VoxelMap& map, const ScanPoints& points, int threads);

} // namespace nurbs
} // namespace pcl
