// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/exports.h>
#include <pcl/mapping/trajectory.h>

namespace pcl {
namespace nurbs {

/** \brief Built-in drives. */
enum class CircuitShape {
  Block,     /**< around a block with rounded corners */
  Oval,      /**< always turning */
  Eight,     /**< crosses itself at right angles */
  Line,      /**< level and straight, not closed */
  Standstill /**< for as long as a lap of Line takes */
};

/** \brief How a circuit is driven. */
struct CircuitOptions {
  CircuitShape shape = CircuitShape::Block;
  double size = 120.0;  /**< longer extent, metres, at least 60; length of a Line */
  double speed = 8.0;   /**< m/s */
  double period = 0.1;  /**< between poses, seconds */
  double height = 1.89; /**< of the poses above the ground, metres */
  double laps = 1.2; /**< more than one, to meet the start again; Line's end is \a size
                      * times this away */
};

/** \brief A drive through gentle hills, closed save for Line: x ahead, y left, z up,
 * starting at (0,
 * 0, height) with a level x axis. O(poses). \throws std::invalid_argument when an
 * option makes no sense or there would be more than 10^6 poses \ingroup mapping */
PCL_NURBS_MAPPING_EXPORT Trajectory
makeCircuit(const CircuitOptions& options = {});

} // namespace nurbs
} // namespace pcl
