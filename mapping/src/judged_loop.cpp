// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "judged_loop.h"

#include <boost/math/distributions/chi_squared.hpp>

#include <stdexcept>

namespace pcl {
namespace nurbs {

JudgedLoop
judgedLoop(const PoseGraph& graph, FactorId id, double probability)
{
  const PoseFactor& factor = graph.factor(id);
  if (!std::holds_alternative<BetweenFactor>(factor.measurement))
    throw std::invalid_argument("factor " + std::to_string(id) +
                                " is no between factor, so it is no loop");
  JudgedLoop loop;
  loop.measured = measuredLoop(graph, id);
  loop.factor = problemFactorOf(
      id, {factor.measurement, 1.0}, graph, PoseGraphCost::Information);
  loop.limit = chiSquareQuantile(freedomOf(loop.measured), probability);
  loop.verdict.factor = id;
  return loop;
}

int
freedomOf(const MeasuredLoop& loop)
{
  return loop.planar ? 3 : 6;
}

double
chiSquareQuantile(int freedom, double probability)
{
  return boost::math::quantile(boost::math::chi_squared(freedom), probability);
}

double
residualOf(const JudgedLoop& loop, const PoseGraph& graph)
{
  return costOf(loop.factor,
                toSolverPose(graph.node(loop.measured.from).T_world_node),
                toSolverPose(graph.node(loop.measured.to).T_world_node));
}

} // namespace nurbs
} // namespace pcl
