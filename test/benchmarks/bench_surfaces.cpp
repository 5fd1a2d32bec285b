// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Surfaces of a 640 x 480 Kinect cloud, of a turn of KITTI's laser (public data sets)
// and of a 64 x 2048 image of a simulated street, by one and two threads: the whole of
// segment(), and with NURBS fits.

#include "data_clouds.h"

#include <pcl/common/io.h>
#include <pcl/mapping/nurbs_reconstruction.h>
#include <pcl/mapping/scan_readers.h>
#include <pcl/mapping/simulator/circuits.h>
#include <pcl/mapping/simulator/simulated_drive.h>
#include <pcl/segmentation/entropy_rate_segmentation.h>

#include <benchmark/benchmark.h>

namespace {

using benchmark::State;
using namespace pcl;
using namespace pcl::nurbs;
using Cloud = PointCloud<PointXYZ>;

/** A whole turn of an HDL-64E; none, and an error of the benchmark, when it is not
 * there. */
Cloud::ConstPtr
laserScan(State& state)
{
  const auto root = test::dataRoot() / "kitti_odometry";
  if (!std::filesystem::exists(root)) {
    state.SkipWithError("data set kitti_odometry is not there");
    return nullptr;
  }
  const Scan scan = openKittiOdometry(root.string(), "00")->read(0);
  auto cloud = pcl::make_shared<Cloud>();
  copyPointCloud(*scan.cloud, *cloud);
  return cloud;
}

void
surfaces(State& state,
         const Cloud::ConstPtr& cloud,
         const std::optional<GridGeometry>& geometry)
{
  EntropyRateSegmentation<PointXYZ> segmentation;
  segmentation.setNumberOfThreads(static_cast<unsigned int>(state.range(0)));
  if (geometry)
    segmentation.setGeometry(*geometry);
  segmentation.setInputCloud(cloud);
  bench::measureSegment(state, segmentation);
}

void
officeSurfaces(State& state)
{
  if (const Cloud::ConstPtr cloud = bench::office(state))
    surfaces(state, cloud, {});
}

void
imageSurfaces(State& state, const Cloud::ConstPtr& image, const GridGeometry& geometry)
{
  surfaces(state, image, geometry);
  state.counters["columns"] = image->width;
  state.counters["rows"] = image->height;
}

/** The image of the laser is given, as drivers give it. */
void
laserSurfaces(State& state)
{
  const Cloud::ConstPtr cloud = laserScan(state);
  if (!cloud)
    return;
  CloudOrganizer<PointXYZ> organizer;
  organizer.setInputCloud(cloud);
  auto image = pcl::make_shared<Cloud>();
  organizer.organize(*image);
  imageSurfaces(state, image, organizer.getGeometry());
}

void
simulatedSurfaces(State& state)
{
  LaserModel laser = LaserModel::hdl64();
  laser.columns = 2048;
  const SimulatedDrive drive(makeCircuit(), laser);
  auto image = pcl::make_shared<Cloud>();
  copyPointCloud(*drive.simulate(0).scan.cloud, *image);
  imageSurfaces(state, image, laser.geometry());
}

void
laserOrganized(State& state)
{
  const Cloud::ConstPtr cloud = laserScan(state);
  if (!cloud)
    return;
  CloudOrganizer<PointXYZ> organizer;
  organizer.setNumberOfThreads(static_cast<unsigned int>(state.range(0)));
  organizer.setInputCloud(cloud);
  Cloud image;
  for (auto _ : state)
    organizer.organize(image);
}

void
officePatches(State& state)
{
  const Cloud::ConstPtr cloud = bench::office(state);
  if (!cloud)
    return;
  ReconstructionOptions options;
  options.threads = static_cast<int>(state.range(0));
  NurbsReconstruction<PointXYZ> reconstruction;
  reconstruction.setOptions(options);
  reconstruction.setInputCloud(cloud);
  SurfaceModel model;
  for (auto _ : state)
    reconstruction.reconstruct(model);
  state.counters["patches"] = static_cast<double>(model.patches.size());
}

constexpr auto kUnit = benchmark::kMillisecond;

void
byThreads(benchmark::internal::Benchmark* row)
{
  row->Arg(1)->Arg(2)->Unit(kUnit)->UseRealTime();
}

BENCHMARK(officeSurfaces)->Name("surfaces_vga/ours")->Apply(byThreads);
BENCHMARK(officePatches)->Name("patches_vga/ours")->Apply(byThreads);
BENCHMARK(laserSurfaces)->Name("surfaces_laser/ours")->Apply(byThreads);
BENCHMARK(simulatedSurfaces)->Name("surfaces_simulated/ours")->Apply(byThreads);
BENCHMARK(laserOrganized)->Name("organize_laser/ours")->Apply(byThreads);

} // namespace
