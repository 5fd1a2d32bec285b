// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// segmentation_scaling PLOT.png: time and memory of the graph, of superpixels and of
// surface grouping from 10^4 to 10^7 points. Prints the table of
// doc/segmentation_scaling.md and draws times over points, both as logarithms.
//
// Every measurement is a process of its own, whose peak of resident memory is that of
// the task alone: points (16 bytes each, made in place), graph, labels and whatever is
// there in between; the cloud they came from is not there.

#include "line_plot.h"

#include <pcl/segmentation/superpixels.h>
#include <pcl/segmentation/surface_grouping.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using Clock = std::chrono::steady_clock;

/** Steps of a chessboard, 2 and 2.2 m from a noisy camera. */
GridPoints
chessboard(std::size_t count)
{
  const auto width =
      static_cast<int>(std::sqrt(static_cast<double>(count) * 4.0 / 3.0));
  const int height = static_cast<int>(count / static_cast<std::size_t>(width));
  GridPoints points;
  points.geometry = GridGeometry::pinhole(
      width, height, {0.8 * width, 0.8 * width, 0.5 * width, 0.5 * height});
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.6 / width);
  points.x.reserve(count);
  points.y.reserve(count);
  points.z.reserve(count);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const int field = column * 8 / width + row * 8 / width;
      const double z = 2.0 + 0.2 * (field % 2) + noise(random);
      const double u = points.geometry.first_u + column * points.geometry.step_u;
      const double v = points.geometry.first_v + row * points.geometry.step_v;
      points.x.push_back(static_cast<float>(u * z));
      points.y.push_back(static_cast<float>(v * z));
      points.z.push_back(static_cast<float>(z));
    }
  completeGridPoints(points);
  return points;
}

struct Measurement {
  double graph = 0.0; // seconds
  double task = 0.0;
  double megabytes = 0.0;
  std::uint32_t segments = 0;
};

double
secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double
residentMegabytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

Measurement
measure(std::size_t count, bool surfaces, int threads)
{
  Measurement result;
  const double before = residentMegabytes();
  const GridPoints points = chessboard(count);
  const SensorNoise noise{0.6 / points.geometry.width, 0.0, 0.0};
  GridGraph graph;
  GridGraphOptions graph_options;
  graph_options.threads = threads;
  auto start = Clock::now();
  graph.build(points, noise, graph_options);
  graph.setWeights();
  result.graph = secondsSince(start);
  start = Clock::now();
  std::vector<std::uint32_t> labels;
  if (surfaces) {
    SurfaceGroupingOptions options;
    options.threads = threads;
    result.segments = groupSurfaces(points, graph, noise, options, labels);
  }
  else
    result.segments =
        gridSuperpixels(points, graph, 1e-4F, {count / 300 + 1, 0.5, 100}).count;
  result.task = secondsSince(start);
  result.megabytes = residentMegabytes() - before;
  return result;
}

/** Do it in a child, so that nothing that was there before counts. */
Measurement
measureApart(std::size_t count, bool surfaces, int threads)
{
  int channel[2];
  if (pipe(channel) != 0)
    throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    const Measurement result = measure(count, surfaces, threads);
    const bool sent = write(channel[1], &result, sizeof(result)) == sizeof(result);
    _exit(sent ? 0 : 1);
  }
  Measurement result;
  const bool got = read(channel[0], &result, sizeof(result)) == sizeof(result);
  waitpid(child, nullptr, 0);
  close(channel[0]);
  close(channel[1]);
  if (child < 0 || !got)
    throw std::runtime_error("a measurement failed");
  return result;
}

void
printRow(const std::string& name, std::size_t count, const Measurement& result)
{
  const auto points = static_cast<double>(count);
  std::printf("| %s | %.0e | %.4f | %.4f | %.3f | %.0f | %u |\n",
              name.c_str(),
              points,
              result.graph,
              result.task,
              1e6 * result.task / points,
              result.megabytes * 1024.0 * 1024.0 / points,
              result.segments);
  std::fflush(stdout);
}

void
run(const std::string& path)
{
  pcl_nurbs_tools::LinePlot plot{
      "Time over points", "log10 (points)", "log10 (seconds)", true, {}};
  const std::vector<std::size_t> counts = {
      10000, 31623, 100000, 316228, 1000000, 3162278, 10000000};
  std::printf("| task | points | graph s | task s | task us/point | bytes/point | "
              "segments |\n| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const auto& [name, surfaces, threads] : {std::tuple("superpixels", false, 1),
                                                {"surfaces, 1 thread", true, 1},
                                                {"surfaces, 2 threads", true, 2}}) {
    pcl_nurbs_tools::PlotLine line{name, {}};
    for (const std::size_t count : counts) {
      const Measurement result = measureApart(count, surfaces, threads);
      printRow(name, count, result);
      line.points.emplace_back(std::log10(static_cast<double>(count)),
                               std::log10(result.task));
    }
    plot.lines.push_back(line);
  }
  pcl_nurbs_tools::writePlot(path, plot);
}

} // namespace

int
main(int argc, char** argv)
{
  if (argc != 2) {
    std::fprintf(stderr, "usage: segmentation_scaling PLOT.png\n");
    return 1;
  }
  try {
    run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "segmentation_scaling: %s\n", error.what());
    return 1;
  }
  return 0;
}
