// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "test_data.h"

#include <pcl/PointIndices.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <benchmark/benchmark.h>

#include <vector>

namespace pcl {
namespace nurbs {
namespace bench {

/** \brief A 640 x 480 Kinect cloud of the public data sets; none, and an error of the
 * benchmark, when it is not there. */
inline PointCloud<PointXYZ>::ConstPtr
office(benchmark::State& state)
{
  const auto file = test::dataRoot() / "pcl_organized" / "office1.pcd";
  auto cloud = pcl::make_shared<PointCloud<PointXYZ>>();
  if (std::filesystem::exists(file) && io::loadPCDFile(file.string(), *cloud) == 0)
    return cloud;
  state.SkipWithError("data set pcl_organized is not there");
  return nullptr;
}

/** \brief Time segment() of a segmentation that has its input; counter "segments". */
template <typename Segmentation>
void
measureSegment(benchmark::State& state, Segmentation& segmentation)
{
  std::vector<PointIndices> segments;
  for (auto _ : state)
    segmentation.segment(segments);
  state.counters["segments"] = static_cast<double>(segments.size());
}

} // namespace bench
} // namespace nurbs
} // namespace pcl
