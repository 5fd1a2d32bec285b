// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "odometry_uncertainty.h"

#include <pcl/mapping/maximum_clique.h>

namespace pcl {
namespace nurbs {

/** A loop as measured. */
struct MeasuredLoop {
  FactorId id = 0;
  NodeId from = 0;
  NodeId to = 0;
  UncertainMotion measured;
  bool planar = false;
};

MeasuredLoop
measuredLoop(const PoseGraph& graph,
             FactorId id,
             const BetweenFactor& between,
             const NoiseScale& scale = {});

/** How far a loop is from the odometry between its ends, and the covariance of that. */
struct CycleError {
  Tangent error = Tangent::Zero();
  TangentMatrix covariance = TangentMatrix::Zero();
};

/** Nothing if odometry does not join the ends. O(1). */
std::optional<CycleError>
cycleError(const MeasuredLoop& loop, const OdometryUncertainty& odometry);

/** d^2 of the cycle of a loop and the odometry between its ends; nothing if that does
 * not join them. O(1). */
std::optional<double>
cycleDistance(const MeasuredLoop& loop, const OdometryUncertainty& odometry);

/** Error of the cycle of two loops and the odometry between their ends, at the end of
 * the first, the covariances taken as independent (Mangelson, Dominic, Eustice,
 * Vasudevan, Pairwise consistent measurement set maximization for robust multi-robot
 * map merging, ICRA 2018); nothing if odometry does not join the ends. O(1). */
std::optional<CycleError>
pairError(const MeasuredLoop& a,
          const MeasuredLoop& b,
          const OdometryUncertainty& odometry);

/** Which pairs have at most this distance, or none. O(n^2). */
NeighbourSets
consistentPairs(const std::vector<MeasuredLoop>& loops,
                const OdometryUncertainty& odometry,
                double max_distance);

} // namespace nurbs
} // namespace pcl
