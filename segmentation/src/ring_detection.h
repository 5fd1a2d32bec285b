// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_layout.h>

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** Chart coordinates (u, v, depth) of a cloud's points; NaN for points without. */
using ChartList = std::vector<Eigen::Vector3f>;

/** Scan lines of a turning laser. */
struct Rings {
  std::vector<std::int32_t> ring; /**< per point, from the top; -1 = none */
  std::vector<double> depression; /**< typical angle per ring, increasing */
  double azimuth_step = 0.0;      /**< typical turn between neighbours of a ring */

  explicit operator bool() const { return !depression.empty(); }
};

/** Rings of a cloud stored ring by ring, wherever they begin. Empty when the order of
 * the points says otherwise. */
Rings
ringsFromOrder(const ChartList& spherical);

/** Rings as clusters of depression angles, for clouds in any order. Empty when the
 * angles are not clustered. */
Rings
ringsFromAngles(const ChartList& spherical);

} // namespace nurbs
} // namespace pcl
