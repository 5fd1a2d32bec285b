// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** Points of a turning laser in the order they were stored in, without those that have
 * no direction. Azimuths grow with the order: a laser that turns the other way has
 * them mirrored. */
struct Sweep {
  std::vector<std::size_t> point; /**< index in the cloud */
  std::vector<float> azimuth;     /**< within half a turn of forward */
  std::vector<float> depression;
  std::vector<float> depth;
  std::vector<std::int32_t> turn; /**< counted where the laser looks back; from 0 */
  std::int32_t turns = 0;         /**< one more than the last turn */
};

/** The sweep of a cloud given in spherical chart coordinates (azimuth, depression,
 * depth). \param sense 1 if azimuths grow with the order, -1 if they fall */
Sweep
sweepOf(const std::vector<Eigen::Vector3f>& charts, float sense);

/** Place of each ring's first point in the sweep. No sensor has to begin its rings at
 * an azimuth known beforehand: from neighbour to neighbour the depression goes up and
 * down and comes back to where it was, but for one azimuth, where it goes on from ring
 * to ring and its steps add up to the field of view. Beams that pass that azimuth a
 * little early or late are parted where their depression steps. O(points). */
std::vector<std::size_t>
ringStarts(const Sweep& sweep);

} // namespace nurbs
} // namespace pcl
