// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/lazy_kd_tree.h>
#include <pcl/registration/scan_preprocessing.h>
#include <pcl/registration/scan_registration.h>

#include <pcl/common/transforms.h>
#include <pcl/console/print.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace pcl {

template <typename PointT>
ScanRegistration<PointT>::ScanRegistration()
{
  reg_name_ = "ScanRegistration";
  max_iterations_ = options_.max_iterations;
  tree_.reset(new LazyKdTree<PointT>);
}

template <typename PointT>
void
ScanRegistration<PointT>::forgetResult()
{
  converged_ = false;
  final_transformation_ = transformation_ = Matrix4::Identity();
  nr_iterations_ = 0;
  result_ = nurbs::MatchResult();
}

template <typename PointT>
void
ScanRegistration<PointT>::setInputSource(const PointCloudSourceConstPtr& cloud)
{
  forgetResult();
  input_.reset(); // an earlier cloud must not stand in for a bad one
  if (cloud)
    Base::setInputSource(cloud);
  else
    PCL_ERROR("[pcl::ScanRegistration::setInputSource] No cloud given.\n");
}

template <typename PointT>
void
ScanRegistration<PointT>::setInputTarget(const PointCloudTargetConstPtr& cloud)
{
  forgetResult();
  target_.reset();
  map_.reset();
  if (cloud)
    Base::setInputTarget(cloud);
  else
    PCL_ERROR("[pcl::ScanRegistration::setInputTarget] No cloud given.\n");
}

template <typename PointT>
void
ScanRegistration<PointT>::buildMap()
{
  const nurbs::ScanPoints points = nurbs::finitePoints(*target_);
  nurbs::VoxelMapOptions map_options;
  map_options.voxel_size =
      voxel_size_ > 0.0 ? voxel_size_ : nurbs::suitableVoxelSize(points);
  map_options.max_points = 25;
  map_options.min_spacing = 0.1 * map_options.voxel_size;
  nurbs::VoxelMap map(map_options);
  for (const Eigen::Vector3f& point : points)
    map.insert(point.cast<double>());
  map_ = std::make_shared<nurbs::MapPyramid>(std::move(map), coarser_maps_);
}

template <typename PointT>
nurbs::ScanPoints
ScanRegistration<PointT>::sourcePoints() const
{
  const nurbs::ScanPoints points = nurbs::finitePoints(*input_, *indices_);
  return source_spacing_ > 0.0 ? nurbs::voxelSubsample(points, source_spacing_)
                               : points;
}

template <typename PointT>
nurbs::MatchOptions
ScanRegistration<PointT>::matchOptions() const
{
  nurbs::MatchOptions options = options_;
  options.max_iterations = max_iterations_;
  options.max_distance = corr_dist_threshold_;
  if (transformation_epsilon_ > 0.0)
    options.translation_epsilon = std::sqrt(transformation_epsilon_);
  if (transformation_rotation_epsilon_ > 0.0)
    options.rotation_epsilon =
        std::acos(std::min(transformation_rotation_epsilon_, 1.0));
  return options;
}

template <typename PointT>
void
ScanRegistration<PointT>::checkGuess(const Matrix4& guess)
{
  constexpr float kTolerance = 1e-3F; // what products of many floats may be off by
  if (!guess.allFinite())
    throw std::invalid_argument("the initial guess is not finite");
  const auto rotation = guess.template topLeftCorner<3, 3>();
  if (!(rotation * rotation.transpose()).isIdentity(kTolerance) ||
      rotation.determinant() < 0.0F ||
      !guess.row(3).isApprox(Matrix4::Identity().row(3), kTolerance))
    throw std::invalid_argument("the initial guess is not a rigid motion");
}

template <typename PointT>
nurbs::MatchResult
ScanRegistration<PointT>::match(const Matrix4& guess)
{
  checkGuess(guess);
  if (!map_)
    buildMap();
  if (map_->fine().empty())
    throw std::invalid_argument("no finite point in the target within a million voxels "
                                "of its origin");
  const nurbs::ScanPoints points = sourcePoints();
  if (points.empty())
    throw std::invalid_argument("no finite point in the source");
  const nurbs::MatchOptions options = matchOptions();
  nurbs::ScanPoints normals;
  if (options.metric == nurbs::MatchMetric::PlaneToPlane) {
    nurbs::VoxelMap own(map_->fine().options());
    for (const Eigen::Vector3f& point : points)
      own.insert(point.cast<double>());
    normals = nurbs::surfaceNormals(own, points, options.threads);
  }
  Eigen::Isometry3d start(guess.template cast<double>());
  return map_->match(points, normals, nurbs::orthonormal(start), options);
}

template <typename PointT>
void
ScanRegistration<PointT>::computeTransformation(PointCloudSource& output,
                                                const Matrix4& guess)
{
  forgetResult();
  try {
    result_ = match(guess);
  } catch (const std::invalid_argument& error) {
    PCL_ERROR("[pcl::ScanRegistration::align] %s\n", error.what());
    return;
  }
  nr_iterations_ = result_.iterations;
  converged_ = result_.converged;
  final_transformation_ = result_.pose.matrix().template cast<float>();
  transformation_ = final_transformation_;
  transformPointCloud(output, output, final_transformation_);
  if (result_.correspondences == 0)
    PCL_ERROR("[pcl::ScanRegistration::align] The scans do not overlap: fewer than six "
              "pairs.\n");
  else if (result_.degeneracy.unsupported == 6)
    PCL_ERROR("[pcl::ScanRegistration::align] No direction of the pose is held: the "
              "points have no surface.\n");
}

} // namespace pcl

#define PCL_INSTANTIATE_ScanRegistration(T)                                            \
  template class PCL_NURBS_REGISTRATION_EXPORT pcl::ScanRegistration<T>;
