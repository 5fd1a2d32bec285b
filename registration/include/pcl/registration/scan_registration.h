// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/map_pyramid.h>

#include <pcl/registration/registration.h>

#include <memory>

namespace pcl {

/** \brief Aligns two scans: a drop-in for pcl::IterativeClosestPoint and
 * pcl::GeneralizedIterativeClosestPoint that says how sure it is.
 *
 * Pairs are found in a voxel map of the target in several threads; no kd-tree is built
 * (but by the first getFitnessScore()). Beyond what pcl::Registration offers: robust
 * kernels, covariance and information of the result, directions without support.
 * setMaxCorrespondenceDistance() and setMaximumIterations() mean what they mean in PCL;
 * setTransformationEpsilon() is, as there, the square of the smallest translation that
 * counts and setTransformationRotationEpsilon() the cosine of the smallest rotation.
 * setIndices() is respected, by align() and its output. Iterations are counted per map
 * (see setCoarserMaps()), and one that ends by their number has not converged, other
 * than in PCL. setEuclideanFitnessEpsilon(), the settings of RANSAC (a robust kernel
 * does their work), rejectors, estimators and search methods of the base are not used.
 *
 * What cannot be aligned (no points, no overlap, points without a surface, a guess that
 * is no rigid motion) is said by PCL_ERROR and hasConverged() is false; the pose stays
 * finite. Coordinates must lie within a million voxels of the origin.
 *
 * \code
 * pcl::ScanRegistration<pcl::PointXYZ> registration;
 * registration.setInputTarget (first);
 * registration.setInputSource (second);
 * pcl::PointCloud<pcl::PointXYZ> aligned;
 * registration.align (aligned);
 * if (registration.hasConverged ())
 *   use (registration.getFinalTransformation (), registration.getCovariance ());
 * \endcode
 * \ingroup registration */
template <typename PointT>
class ScanRegistration : public Registration<PointT, PointT> {
  using Base = Registration<PointT, PointT>;
  using Base::converged_;
  using Base::corr_dist_threshold_;
  using Base::final_transformation_;
  using Base::indices_;
  using Base::input_;
  using Base::max_iterations_;
  using Base::nr_iterations_;
  using Base::reg_name_;
  using Base::target_;
  using Base::transformation_;
  using Base::transformation_epsilon_;
  using Base::transformation_rotation_epsilon_;
  using Base::tree_;

public:
  using Ptr = shared_ptr<ScanRegistration<PointT>>;
  using ConstPtr = shared_ptr<const ScanRegistration<PointT>>;
  using typename Base::Matrix4;
  using typename Base::PointCloudSource;
  using typename Base::PointCloudSourceConstPtr;
  using typename Base::PointCloudTargetConstPtr;

  ScanRegistration();

  void
  setInputSource(const PointCloudSourceConstPtr& cloud) override;

  void
  setInputTarget(const PointCloudTargetConstPtr& cloud) override;

  /** \brief What is made small (default: point to plane). */
  void
  setMetric(nurbs::MatchMetric metric)
  {
    options_.metric = metric;
  }

  nurbs::MatchMetric
  getMetric() const
  {
    return options_.metric;
  }

  /** \brief Loss of large residuals (default: Geman-McClure, width from the data). */
  void
  setRobustKernel(const nurbs::RobustKernel& kernel)
  {
    options_.kernel = kernel;
  }

  const nurbs::RobustKernel&
  getRobustKernel() const
  {
    return options_.kernel;
  }

  /** \brief Edge of the target's voxels, metres; half the extent of the patches that
   * normals come from. 0, the default, chooses the smallest that finds the target's
   * flat places. */
  void
  setVoxelSize(double size)
  {
    voxel_size_ = size;
    map_.reset();
  }

  /** \brief The size in use after align(), or the one set. */
  double
  getVoxelSize() const
  {
    return map_ ? map_->fine().options().voxel_size : voxel_size_;
  }

  /** \brief Number of coarser maps that bring rough guesses home before the fine one
   * decides (default 4), each with voxels of twice the size. More reach farther. */
  void
  setCoarserMaps(int count)
  {
    coarser_maps_ = std::max(count, 0);
    map_.reset();
  }

  int
  getCoarserMaps() const
  {
    return coarser_maps_;
  }

  /** \brief Use one point of the source per voxel of this size; 0, the default, uses
   * all. */
  void
  setSourceSpacing(double spacing)
  {
    source_spacing_ = spacing;
  }

  double
  getSourceSpacing() const
  {
    return source_spacing_;
  }

  /** \brief See nurbs::MatchOptions::min_support. */
  void
  setMinSupport(double share)
  {
    options_.min_support = share;
  }

  /** \brief Number of threads (default 1); the result does not depend on it. */
  void
  setNumberOfThreads(unsigned int threads)
  {
    options_.threads = static_cast<int>(std::max(threads, 1U));
  }

  /** \brief Covariance of the result in the source's frame, (translation, rotation):
   * see nurbs::Tangent. Zero when the last align() failed. */
  const nurbs::TangentMatrix&
  getCovariance() const
  {
    return result_.covariance;
  }

  /** \brief Its inverse, with zeros in directions without support. */
  const nurbs::TangentMatrix&
  getInformation() const
  {
    return result_.information;
  }

  const nurbs::Degeneracy&
  getDegeneracy() const
  {
    return result_.degeneracy;
  }

  /** \brief All of the last result, in double precision. */
  const nurbs::MatchResult&
  getResult() const
  {
    return result_;
  }

  PCL_MAKE_ALIGNED_OPERATOR_NEW

protected:
  void
  computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

private:
  void
  forgetResult();

  /** \throws std::invalid_argument when it is no rigid motion */
  static void
  checkGuess(const Matrix4& guess);

  void
  buildMap();

  nurbs::ScanPoints
  sourcePoints() const;

  nurbs::MatchOptions
  matchOptions() const;

  nurbs::MatchResult
  match(const Matrix4& guess);

  nurbs::MatchOptions options_;
  double voxel_size_ = 0.0;
  double source_spacing_ = 0.0;
  int coarser_maps_ = 4;
  std::shared_ptr<const nurbs::MapPyramid> map_;
  nurbs::MatchResult result_;
};

} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl/registration/impl/scan_registration.hpp>
#endif
