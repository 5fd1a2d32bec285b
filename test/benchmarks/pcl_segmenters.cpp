// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "pcl_segmenters.h"

#include <pcl/common/io.h>
#include <pcl/features/integral_image_normal.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/lccp_segmentation.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>
#include <pcl/segmentation/region_growing.h>
#include <pcl/segmentation/supervoxel_clustering.h>

#include <cmath>
#include <map>
#include <sstream>

namespace pcl {
namespace nurbs {
namespace bench {
namespace {

using Labels = std::vector<std::uint32_t>;
using ColorCloud = pcl::PointCloud<pcl::PointXYZRGBA>;

constexpr int kLeast = 100; // points of a segment
constexpr double kDegree = M_PI / 180.0;

std::string
text(double number)
{
  std::ostringstream out;
  out << number;
  return out.str();
}

Labels
labelsOf(const std::vector<PointIndices>& clusters, std::size_t points)
{
  Labels labels(points, 0);
  for (std::size_t k = 0; k < clusters.size(); ++k)
    for (const auto index : clusters[k].indices)
      labels[static_cast<std::size_t>(index)] = static_cast<std::uint32_t>(k + 1);
  return labels;
}

/** Valid points alone, and where they were. */
struct Compact {
  explicit Compact(const Cloud& cloud)
  {
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (std::isfinite(cloud[i].z)) {
        points->push_back(cloud[i]);
        where.push_back(i);
      }
  }

  Labels
  spread(const Labels& labels, std::size_t size) const
  {
    Labels result(size, 0);
    for (std::size_t k = 0; k < where.size(); ++k)
      result[where[k]] = labels[k];
    return result;
  }

  Cloud::Ptr points{new Cloud};
  std::vector<std::size_t> where;
};

Setting
multiPlane(double degrees, double distance)
{
  const auto segment = [=](const Cloud::ConstPtr& cloud) {
    pcl::IntegralImageNormalEstimation<PointXYZ, Normal> estimation;
    estimation.setNormalEstimationMethod(estimation.COVARIANCE_MATRIX);
    estimation.setMaxDepthChangeFactor(0.02F);
    estimation.setNormalSmoothingSize(10.0F);
    estimation.setInputCloud(cloud);
    pcl::PointCloud<Normal>::Ptr normals(new pcl::PointCloud<Normal>);
    estimation.compute(*normals);
    pcl::OrganizedMultiPlaneSegmentation<PointXYZ, Normal, Label> planes;
    planes.setMinInliers(kLeast);
    planes.setAngularThreshold(degrees * kDegree);
    planes.setDistanceThreshold(distance);
    planes.setInputNormals(normals);
    planes.setInputCloud(cloud);
    std::vector<PlanarRegion<PointXYZ>,
                Eigen::aligned_allocator<PlanarRegion<PointXYZ>>>
        regions;
    std::vector<ModelCoefficients> coefficients;
    std::vector<PointIndices> inliers;
    std::vector<PointIndices> label_indices;
    std::vector<PointIndices> boundaries;
    pcl::PointCloud<Label>::Ptr labels(new pcl::PointCloud<Label>);
    planes.segmentAndRefine(
        regions, coefficients, inliers, labels, label_indices, boundaries);
    return labelsOf(inliers, cloud->size());
  };
  return {text(degrees) + " deg " + text(distance) + " m", segment};
}

Setting
regionGrowing(int neighbours, double degrees, double curvature)
{
  const auto segment = [=](const Cloud::ConstPtr& cloud) {
    const Compact compact(*cloud);
    const pcl::search::KdTree<PointXYZ>::Ptr tree(new pcl::search::KdTree<PointXYZ>);
    tree->setInputCloud(compact.points);
    pcl::NormalEstimationOMP<PointXYZ, Normal> estimation(2);
    estimation.setInputCloud(compact.points);
    estimation.setSearchMethod(tree);
    estimation.setKSearch(neighbours);
    pcl::PointCloud<Normal>::Ptr normals(new pcl::PointCloud<Normal>);
    estimation.compute(*normals);
    pcl::RegionGrowing<PointXYZ, Normal> growing;
    growing.setMinClusterSize(kLeast);
    growing.setSearchMethod(tree);
    growing.setNumberOfNeighbours(30);
    growing.setInputCloud(compact.points);
    growing.setInputNormals(normals);
    growing.setSmoothnessThreshold(static_cast<float>(degrees * kDegree));
    growing.setCurvatureThreshold(static_cast<float>(curvature));
    std::vector<PointIndices> clusters;
    growing.extract(clusters);
    return compact.spread(labelsOf(clusters, compact.points->size()), cloud->size());
  };
  return {text(neighbours) + " neighbours " + text(degrees) + " deg " + text(curvature),
          segment};
}

/** Supervoxels, and if \a concavity is not negative joined where they are convex. */
Setting
supervoxels(double voxel, double seed, double concavity)
{
  const auto segment = [=](const Cloud::ConstPtr& cloud) {
    const Compact compact(*cloud);
    ColorCloud::Ptr colored(new ColorCloud);
    pcl::copyPointCloud(*compact.points, *colored);
    pcl::SupervoxelClustering<PointXYZRGBA> clustering(static_cast<float>(voxel),
                                                       static_cast<float>(seed));
    clustering.setInputCloud(colored);
    clustering.setColorImportance(0.0F);
    clustering.setSpatialImportance(0.4F);
    clustering.setNormalImportance(1.0F);
    std::map<std::uint32_t, Supervoxel<PointXYZRGBA>::Ptr> voxels;
    clustering.extract(voxels);
    const pcl::PointCloud<PointXYZL>::Ptr labelled = clustering.getLabeledCloud();
    if (concavity >= 0.0) {
      std::multimap<std::uint32_t, std::uint32_t> adjacency;
      clustering.getSupervoxelAdjacency(adjacency);
      pcl::LCCPSegmentation<PointXYZRGBA> lccp;
      lccp.setConcavityToleranceThreshold(static_cast<float>(concavity));
      lccp.setSanityCheck(true);
      lccp.setSmoothnessCheck(
          true, static_cast<float>(voxel), static_cast<float>(seed), 0.1F);
      lccp.setInputSupervoxels(voxels, adjacency);
      lccp.setMinSegmentSize(3);
      lccp.segment();
      lccp.relabelCloud(*labelled);
    }
    Labels labels;
    for (const PointXYZL& point : *labelled)
      labels.push_back(point.label);
    return compact.spread(labels, cloud->size());
  };
  return {"voxel " + text(voxel) + " seed " + text(seed) + " m", segment};
}

Setting
euclidean(double tolerance)
{
  const auto segment = [=](const Cloud::ConstPtr& cloud) {
    const Compact compact(*cloud);
    const pcl::search::KdTree<PointXYZ>::Ptr tree(new pcl::search::KdTree<PointXYZ>);
    tree->setInputCloud(compact.points);
    pcl::EuclideanClusterExtraction<PointXYZ> extraction;
    extraction.setClusterTolerance(tolerance);
    extraction.setMinClusterSize(kLeast);
    extraction.setSearchMethod(tree);
    extraction.setInputCloud(compact.points);
    std::vector<PointIndices> clusters;
    extraction.extract(clusters);
    return compact.spread(labelsOf(clusters, compact.points->size()), cloud->size());
  };
  return {text(tolerance) + " m", segment};
}

} // namespace

std::vector<Method>
pclMethods(SceneScale scale)
{
  const bool street = scale == SceneScale::Street;
  const auto chosen = [street](const std::vector<Setting>& room,
                               const std::vector<Setting>& outside) {
    return street ? outside : room;
  };
  return {{"OrganizedMultiPlane",
           chosen({multiPlane(2, 0.01),
                   multiPlane(3, 0.02),
                   multiPlane(6, 0.02),
                   multiPlane(6, 0.05)},
                  {multiPlane(3, 0.05), multiPlane(6, 0.1), multiPlane(10, 0.2)})},
          {"RegionGrowing",
           chosen({regionGrowing(30, 3, 0.05),
                   regionGrowing(50, 3, 1.0),
                   regionGrowing(100, 2, 1.0),
                   regionGrowing(100, 4, 1.0)},
                  {regionGrowing(30, 3, 0.05), regionGrowing(50, 6, 1.0)})},
          {"VCCS",
           chosen({supervoxels(0.006, 0.05, -1),
                   supervoxels(0.01, 0.1, -1),
                   supervoxels(0.02, 0.2, -1)},
                  {supervoxels(0.05, 0.5, -1), supervoxels(0.1, 1.0, -1)})},
          {"VCCS + LCCP",
           chosen({supervoxels(0.006, 0.02, 10),
                   supervoxels(0.006, 0.04, 10),
                   supervoxels(0.01, 0.06, 10),
                   supervoxels(0.02, 0.12, 10)},
                  {supervoxels(0.05, 0.3, 10), supervoxels(0.1, 0.6, 10)})},
          {"EuclideanClusters",
           chosen({euclidean(0.006), euclidean(0.01), euclidean(0.02)},
                  {euclidean(0.1), euclidean(0.3), euclidean(0.6)})}};
}

} // namespace bench
} // namespace nurbs
} // namespace pcl
