// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "loop_cycles.h"

namespace pcl {
namespace nurbs {
namespace {

std::size_t
gap(const OdometryUncertainty& odometry, NodeId a, NodeId b)
{
  const std::size_t first = odometry.indexOf(a);
  const std::size_t second = odometry.indexOf(b);
  return std::max(first, second) - std::min(first, second);
}

/** The loop in the direction whose ends are nearer to those of the other one. */
MeasuredLoop
alongside(const MeasuredLoop& loop,
          const MeasuredLoop& other,
          const OdometryUncertainty& odometry)
{
  const std::size_t same =
      gap(odometry, loop.from, other.from) + gap(odometry, loop.to, other.to);
  const std::size_t opposite =
      gap(odometry, loop.from, other.to) + gap(odometry, loop.to, other.from);
  if (same <= opposite)
    return loop;
  return {loop.id, loop.to, loop.from, reversed(loop.measured), loop.planar};
}

/** One motion after the other, their errors independent. */
UncertainMotion
operator*(const UncertainMotion& first, const UncertainMotion& second)
{
  const TangentMatrix change = adjoint(second.T_from_to.inverse());
  return {first.T_from_to * second.T_from_to,
          second.covariance + change * first.covariance * change.transpose()};
}

} // namespace

MeasuredLoop
measuredLoop(const PoseGraph& graph,
             FactorId id,
             const BetweenFactor& between,
             const NoiseScale& scale)
{
  const bool planar = graph.node(between.from).planar && graph.node(between.to).planar;
  return {id,
          between.from,
          between.to,
          {between.T_from_to, scale.applyTo(covarianceOf(between.information, planar))},
          planar};
}

std::optional<CycleError>
cycleError(const MeasuredLoop& loop, const OdometryUncertainty& odometry)
{
  const auto motion = odometry.motion(loop.from, loop.to);
  if (!motion)
    return std::nullopt;
  return CycleError{logarithm(loop.measured.T_from_to.inverse() * motion->T_from_to),
                    loop.measured.covariance + motion->covariance};
}

std::optional<double>
cycleDistance(const MeasuredLoop& loop, const OdometryUncertainty& odometry)
{
  const auto cycle = cycleError(loop, odometry);
  if (!cycle)
    return std::nullopt;
  return squaredDistance(cycle->error, cycle->covariance, loop.planar);
}

std::optional<CycleError>
pairError(const MeasuredLoop& a,
          const MeasuredLoop& other,
          const OdometryUncertainty& odometry)
{
  const MeasuredLoop b = alongside(other, a, odometry);
  const auto begin = odometry.motion(a.from, b.from);
  const auto end = odometry.motion(b.to, a.to);
  if (!begin || !end)
    return std::nullopt;
  const UncertainMotion round = *begin * b.measured * *end;
  return CycleError{logarithm(a.measured.T_from_to.inverse() * round.T_from_to),
                    a.measured.covariance + round.covariance};
}

NeighbourSets
consistentPairs(const std::vector<MeasuredLoop>& loops,
                const OdometryUncertainty& odometry,
                double max_distance)
{
  NeighbourSets sets(loops.size(), boost::dynamic_bitset<>(loops.size()));
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (std::size_t j = i + 1; j < loops.size(); ++j) {
      const auto cycle = pairError(loops[i], loops[j], odometry);
      const bool consistent =
          !cycle || squaredDistance(cycle->error, cycle->covariance, loops[i].planar) <=
                        max_distance;
      sets[i][j] = consistent;
      sets[j][i] = consistent;
    }
  return sets;
}

} // namespace nurbs
} // namespace pcl
