// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "registration_pairs.h"

#include <string>
#include <vector>

namespace pcl {
namespace nurbs {
namespace bench {

/** Our distances and PCL's registrations. */
enum class Method { Plane, Point, Gicp, PclIcp, PclIcpNormals, PclGicp, PclNdt };

/** "ours" and the names of the rows beside it, by the order of Method. */
const std::vector<std::string>&
methodNames();

/** Align from scratch with one thread: clouds to pose, with whatever trees, maps and
 * normals the method needs. */
Eigen::Isometry3d
align(Method method,
      const PairSet& set,
      const ScanPair& pair,
      const Eigen::Isometry3d& guess);

} // namespace bench
} // namespace nurbs
} // namespace pcl
