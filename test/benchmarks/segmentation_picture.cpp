// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Draws the segments of a cloud in its own raster:
//   segmentation_picture CLOUD|demo OUT.png [surfaces|connected] [THREADS]

#include <pcl/mapping/cloud_reader.h>
#include <pcl/mapping/demo_scene.h>
#include <pcl/segmentation/cloud_organizer.h>
#include <pcl/segmentation/grid_segmentation.h>
#include <pcl/segmentation/surface_grouping.h>
#include <pcl/surface/nurbs/surface_render.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using Clock = std::chrono::steady_clock;

struct Scene {
  PointCloud<PointXYZ>::Ptr cloud{new PointCloud<PointXYZ>};
  GridGeometry geometry;
};

Scene
sceneOf(const std::string& name, unsigned int threads)
{
  CloudOrganizer<PointXYZ> organizer;
  if (name == "demo") {
    const DemoScene demo;
    organizer.setInputCloud(demo.cloud());
  }
  else
    organizer.setInputCloud(readCloud(name).cloud);
  organizer.setNumberOfThreads(threads);
  Scene scene;
  organizer.organize(*scene.cloud);
  scene.geometry = organizer.getGeometry();
  return scene;
}

double
milliseconds(Clock::time_point since)
{
  return 1e3 * std::chrono::duration<double>(Clock::now() - since).count();
}

/** Labels as colours; rows of a laser are repeated, for there are few. */
Image
picture(const GridGeometry& grid, const std::vector<std::uint32_t>& labels)
{
  Image image;
  const int repeat = std::clamp(grid.width / (4 * grid.height), 1, 8);
  image.width = grid.width;
  image.height = grid.height * repeat;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < grid.width; ++column) {
      const RGB color =
          labelColor(labels[static_cast<std::size_t>((row / repeat) * grid.width) +
                            static_cast<std::size_t>(column)]);
      image.pixels.push_back({color.r, color.g, color.b});
    }
  return image;
}

/** How many of the largest segments hold 90 % of the labelled points. */
std::size_t
segmentsForMost(const std::vector<std::uint32_t>& labels, std::uint32_t count)
{
  std::vector<std::size_t> sizes(count + 1, 0);
  for (const std::uint32_t label : labels)
    ++sizes[label];
  const double wanted = 0.9 * static_cast<double>(labels.size() - sizes[0]);
  double sum = 0.0;
  std::size_t segments = 0;
  while (segments < count && sum < wanted)
    sum += static_cast<double>(sizes[++segments]);
  return segments;
}

/** Share of the cells that hold a point but no label. */
double
shareUnlabelled(const GridPoints& points, const std::vector<std::uint32_t>& labels)
{
  std::size_t count = 0;
  for (std::size_t cell = 0; cell < labels.size(); ++cell)
    count += points.valid(cell) && labels[cell] == 0 ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(labels.size());
}

int
draw(const std::string& input,
     const std::string& output,
     bool surfaces,
     unsigned int threads)
{
  const Scene scene = sceneOf(input, threads);
  const GridPoints points = toGridPoints(*scene.cloud, scene.geometry);
  const SensorNoise noise = SensorNoise::estimate(points);
  const Clock::time_point start = Clock::now();
  GridGraphOptions graph_options;
  graph_options.threads = static_cast<int>(threads);
  GridGraph graph;
  graph.build(points, noise, graph_options);
  graph.setWeights();
  const double graph_time = milliseconds(start);
  std::vector<std::uint32_t> labels;
  SurfaceGroupingOptions options;
  options.threads = static_cast<int>(threads);
  ConnectedGroupsOptions connected;
  connected.threads = static_cast<int>(threads);
  const std::uint32_t count =
      surfaces ? groupSurfaces(points, graph, noise, options, labels)
               : connectedGroups(points, graph, noise, connected, labels);
  const double grouping_time = milliseconds(start) - graph_time;
  writePng(output, picture(scene.geometry, labels));
  std::printf("%s: %dx%d, %u segments, %zu hold 90 %%, unlabelled %.1f %%, graph %.1f "
              "ms, grouping %.1f ms\n",
              input.c_str(),
              scene.geometry.width,
              scene.geometry.height,
              count,
              segmentsForMost(labels, count),
              100.0 * shareUnlabelled(points, labels),
              graph_time,
              grouping_time);
  return 0;
}

} // namespace

int
main(int argc, char** argv)
{
  if (argc < 3) {
    std::fprintf(stderr,
                 "usage: %s CLOUD|demo OUT.png [surfaces|connected] [THREADS]\n",
                 argv[0]);
    return 1;
  }
  try {
    const bool surfaces = argc < 4 || std::string(argv[3]) != "connected";
    const auto threads = static_cast<unsigned int>(argc < 5 ? 2 : std::stoi(argv[4]));
    return draw(argv[1], argv[2], surfaces, threads);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
