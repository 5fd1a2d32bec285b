// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "kept_edges.h"

namespace pcl {
namespace nurbs {

/** Unit normals by line fits along rows and columns of kept edges; zero where there are
 * too few points. */
std::vector<Eigen::Vector3f>
gridNormals(const GridPoints& points,
            const KeptEdges& edges,
            const SensorNoise& noise,
            int threads);

/** Marks cells where normals turn by more than the crease angle within a window, over
 * and above the steady curvature beside it. */
std::vector<std::uint8_t>
findCreases(const GridPoints& points,
            const KeptEdges& edges,
            const SensorNoise& noise,
            const ConnectedGroupsOptions& options);

/** Marks cells at most \a radius cells from a crease or a removed edge. */
std::vector<std::uint8_t>
nearBreaks(const GridGeometry& grid,
           const KeptEdges& edges,
           const std::vector<std::uint8_t>& crease,
           int radius);

} // namespace nurbs
} // namespace pcl
