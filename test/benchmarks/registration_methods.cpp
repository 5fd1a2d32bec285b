// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "registration_methods.h"

#include <pcl/registration/scan_registration.h>

#include <pcl/common/io.h>
#include <pcl/features/normal_3d.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>

namespace pcl {
namespace nurbs {
namespace bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using NormalCloud = pcl::PointCloud<pcl::PointNormal>;

template <typename PointT>
Eigen::Isometry3d
run(Registration<PointT, PointT>& registration,
    const typename pcl::PointCloud<PointT>::ConstPtr& target,
    const typename pcl::PointCloud<PointT>::ConstPtr& source,
    const Eigen::Isometry3d& guess)
{
  registration.setInputTarget(target);
  registration.setInputSource(source);
  pcl::PointCloud<PointT> aligned;
  registration.align(aligned, guess.matrix().cast<float>());
  return Eigen::Isometry3d(
      registration.getFinalTransformation().template cast<double>());
}

Eigen::Isometry3d
ours(MatchMetric metric, const ScanPair& pair, const Eigen::Isometry3d& guess)
{
  ScanRegistration<PointXYZ> registration;
  registration.setMetric(metric);
  run<PointXYZ>(registration, pair.target, pair.source, guess);
  return registration.getResult().pose;
}

double
reach(const PairSet& set)
{
  constexpr double kSpacings = 10.0; // rough guesses are off by more than a few
  return kSpacings * set.spacing;
}

template <typename Icp>
void
configure(Icp& icp, const PairSet& set)
{
  icp.setMaxCorrespondenceDistance(reach(set));
  icp.setMaximumIterations(100);
  icp.setTransformationEpsilon(1e-9);
}

NormalCloud::Ptr
withNormals(const Cloud::ConstPtr& cloud)
{
  NormalEstimation<PointXYZ, PointNormal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setKSearch(20);
  NormalCloud::Ptr result(new NormalCloud);
  estimation.compute(*result);
  copyPointCloud(*cloud, *result);
  return result;
}

Eigen::Isometry3d
pclNormals(const PairSet& set, const ScanPair& pair, const Eigen::Isometry3d& guess)
{
  IterativeClosestPointWithNormals<PointNormal, PointNormal> icp;
  configure(icp, set);
  return run<PointNormal>(
      icp, withNormals(pair.target), withNormals(pair.source), guess);
}

Eigen::Isometry3d
pclIcp(const PairSet& set, const ScanPair& pair, const Eigen::Isometry3d& guess)
{
  IterativeClosestPoint<PointXYZ, PointXYZ> icp;
  configure(icp, set);
  return run<PointXYZ>(icp, pair.target, pair.source, guess);
}

Eigen::Isometry3d
pclGicp(const PairSet& set, const ScanPair& pair, const Eigen::Isometry3d& guess)
{
  GeneralizedIterativeClosestPoint<PointXYZ, PointXYZ> gicp;
  gicp.setMaxCorrespondenceDistance(reach(set));
  return run<PointXYZ>(gicp, pair.target, pair.source, guess);
}

Eigen::Isometry3d
pclNdt(const PairSet& set, const ScanPair& pair, const Eigen::Isometry3d& guess)
{
  NormalDistributionsTransform<PointXYZ, PointXYZ> ndt;
  ndt.setResolution(static_cast<float>(reach(set)));
  ndt.setStepSize(0.5 * reach(set));
  ndt.setTransformationEpsilon(1e-6);
  ndt.setMaximumIterations(50);
  return run<PointXYZ>(ndt, pair.target, pair.source, guess);
}

} // namespace

const std::vector<std::string>&
methodNames()
{
  static const std::vector<std::string> names{"ours",
                                              "ours_point_to_point",
                                              "ours_plane_to_plane",
                                              "PCL_ICP",
                                              "PCL_ICP_normals",
                                              "PCL_GICP",
                                              "PCL_NDT"};
  return names;
}

Eigen::Isometry3d
align(Method method,
      const PairSet& set,
      const ScanPair& pair,
      const Eigen::Isometry3d& guess)
{
  switch (method) {
  case Method::Plane:
    return ours(MatchMetric::PointToPlane, pair, guess);
  case Method::Point:
    return ours(MatchMetric::PointToPoint, pair, guess);
  case Method::Gicp:
    return ours(MatchMetric::PlaneToPlane, pair, guess);
  case Method::PclIcp:
    return pclIcp(set, pair, guess);
  case Method::PclIcpNormals:
    return pclNormals(set, pair, guess);
  case Method::PclGicp:
    return pclGicp(set, pair, guess);
  case Method::PclNdt:
    return pclNdt(set, pair, guess);
  }
  return guess;
}

} // namespace bench
} // namespace nurbs
} // namespace pcl
