// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Superpixels of a 640 x 480 Kinect cloud (public data sets, office1) beside the
// segmenters of PCL, and of synthetic clouds from 10^4 to 10^7 points.

#include "chessboard.h"
#include "data_clouds.h"

#include <pcl/features/integral_image_normal.h>
#include <pcl/search/organized.h>
#include <pcl/segmentation/entropy_rate_segmentation.h>
#include <pcl/segmentation/grid_layout.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>
#include <pcl/segmentation/region_growing.h>
#include <pcl/segmentation/supervoxel_clustering.h>

#include <benchmark/benchmark.h>

#include <sys/resource.h>

namespace {

using benchmark::State;
using namespace pcl;
using namespace pcl::nurbs;
using Cloud = PointCloud<PointXYZ>;
using Normals = PointCloud<Normal>;

constexpr float kMinWeight = 1e-4F;

GridPoints
gridOf(const Cloud& cloud)
{
  PointList points;
  for (const PointXYZ& point : cloud)
    points.push_back(point.getVector3fMap());
  return toGridPoints(
      cloud,
      estimateGridGeometry(
          points, static_cast<int>(cloud.width), static_cast<int>(cloud.height), 1));
}

/** Graph, weights and superpixels of points, as the class makes them. */
Superpixels
segmentGrid(const GridPoints& points,
            const SensorNoise& noise,
            int connectivity,
            std::size_t number,
            GridGraph& graph)
{
  GridGraphOptions options;
  options.connectivity = connectivity;
  graph.build(points, noise, options);
  graph.setWeights();
  return gridSuperpixels(points, graph, kMinWeight, {number, 0.5, 100});
}

void
officeSuperpixels(State& state, int connectivity)
{
  const Cloud::ConstPtr cloud = bench::office(state);
  if (!cloud)
    return;
  const GridPoints points = gridOf(*cloud);
  const SensorNoise noise = SensorNoise::estimate(points);
  GridGraph graph;
  Superpixels result = segmentGrid(points, noise, connectivity, 1000, graph);
  for (auto _ : state)
    result = gridSuperpixels(points, graph, kMinWeight, {1000, 0.5, 100});
  state.counters["segments"] = result.count;
}

void
officeSegment(State& state, int connectivity)
{
  const Cloud::ConstPtr cloud = bench::office(state);
  if (!cloud)
    return;
  EntropyRateSegmentation<PointXYZ> segmentation;
  segmentation.setMode(EntropyRateSegmentation<PointXYZ>::SUPERPIXELS);
  segmentation.setConnectivity(connectivity);
  segmentation.setInputCloud(cloud);
  bench::measureSegment(state, segmentation);
}

void
scaling(State& state, int connectivity)
{
  const GridPoints points = bench::chessboard(static_cast<std::size_t>(state.range(0)));
  const SensorNoise noise{0.6 / points.geometry.width, 0.0, 0.0};
  const std::size_t number = points.size() / 300 + 1;
  GridGraph graph;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        segmentGrid(points, noise, connectivity, number, graph).count);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["bytes_per_point"] = 1024.0 * static_cast<double>(usage.ru_maxrss) /
                                      static_cast<double>(points.size());
  state.counters["ns_per_point"] = benchmark::Counter(
      static_cast<double>(points.size()) * 1e-9,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

Normals::Ptr
integralNormals(const Cloud::ConstPtr& cloud)
{
  IntegralImageNormalEstimation<PointXYZ, Normal> estimation;
  estimation.setNormalEstimationMethod(estimation.COVARIANCE_MATRIX);
  estimation.setMaxDepthChangeFactor(0.02F);
  estimation.setNormalSmoothingSize(10.0F);
  estimation.setInputCloud(cloud);
  auto normals = pcl::make_shared<Normals>();
  estimation.compute(*normals);
  return normals;
}

void
pclNormals(State& state)
{
  const Cloud::ConstPtr cloud = bench::office(state);
  if (!cloud)
    return;
  for (auto _ : state)
    benchmark::DoNotOptimize(integralNormals(cloud)->size());
}

void
pclPlanes(State& state)
{
  const Cloud::ConstPtr cloud = bench::office(state);
  if (!cloud)
    return;
  OrganizedMultiPlaneSegmentation<PointXYZ, Normal, Label> segmentation;
  segmentation.setMinInliers(100);
  segmentation.setInputCloud(cloud);
  segmentation.setInputNormals(integralNormals(cloud));
  std::vector<ModelCoefficients> models;
  std::vector<PointIndices> inliers;
  for (auto _ : state)
    segmentation.segment(models, inliers);
  state.counters["segments"] = static_cast<double>(inliers.size());
}

void
pclRegionGrowing(State& state)
{
  const Cloud::ConstPtr cloud = bench::office(state);
  if (!cloud)
    return;
  auto indices = pcl::make_shared<Indices>();
  const Normals::Ptr normals = integralNormals(cloud);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    if (isFinite((*cloud)[i]) && std::isfinite((*normals)[i].normal_x))
      indices->push_back(static_cast<index_t>(i));
  RegionGrowing<PointXYZ, Normal> growing;
  growing.setInputCloud(cloud);
  growing.setIndices(indices);
  growing.setInputNormals(normals);
  growing.setSearchMethod(pcl::make_shared<search::OrganizedNeighbor<PointXYZ>>());
  growing.setMinClusterSize(100);
  growing.setNumberOfNeighbours(30);
  std::vector<PointIndices> clusters;
  for (auto _ : state)
    growing.extract(clusters);
  state.counters["segments"] = static_cast<double>(clusters.size());
}

void
pclSupervoxels(State& state)
{
  const Cloud::ConstPtr cloud = bench::office(state);
  if (!cloud)
    return;
  PointCloud<PointXYZRGBA>::Ptr colored(new PointCloud<PointXYZRGBA>);
  copyPointCloud(*cloud, *colored);
  std::map<std::uint32_t, Supervoxel<PointXYZRGBA>::Ptr> clusters;
  for (auto _ : state) {
    SupervoxelClustering<PointXYZRGBA> clustering(0.02F, 0.2F);
    clustering.setColorImportance(0.0F);
    clustering.setInputCloud(colored);
    clusters.clear();
    clustering.extract(clusters);
  }
  state.counters["segments"] = static_cast<double>(clusters.size());
}

constexpr auto kUnit = benchmark::kMillisecond;

BENCHMARK_CAPTURE(officeSuperpixels, , 8)->Name("superpixels_8/ours")->Unit(kUnit);
BENCHMARK(pclSupervoxels)->Name("superpixels_8/PCL_VCCS")->Unit(kUnit);
BENCHMARK_CAPTURE(officeSuperpixels, , 4)->Name("superpixels_4/ours")->Unit(kUnit);
BENCHMARK_CAPTURE(officeSegment, , 8)->Name("superpixels_whole_8/ours")->Unit(kUnit);
BENCHMARK_CAPTURE(officeSegment, , 4)->Name("superpixels_whole_4/ours")->Unit(kUnit);
BENCHMARK(pclNormals)->Name("segment_normals/PCL_integral")->Unit(kUnit);
BENCHMARK(pclPlanes)->Name("segment_planes/PCL_multi_plane")->Unit(kUnit);
BENCHMARK(pclRegionGrowing)->Name("segment_regions/PCL_growing")->Unit(kUnit);
BENCHMARK_CAPTURE(scaling, , 8)
    ->Name("superpixels_scaling_8/ours")
    ->RangeMultiplier(10)
    ->Range(10000, 10000000)
    ->Unit(kUnit);
BENCHMARK_CAPTURE(scaling, , 4)
    ->Name("superpixels_scaling_4/ours")
    ->RangeMultiplier(10)
    ->Range(10000, 10000000)
    ->Unit(kUnit);

} // namespace
