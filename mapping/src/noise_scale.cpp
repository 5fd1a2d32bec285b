// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "noise_scale.h"

#include "chi_square.h"
#include "pose_graph_problem.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kSmallestScale = 1e-4;

/** Loops whose ends odometry joins, the shorter way first. */
std::vector<MeasuredLoop>
loopsByLength(const PoseGraph& graph, const std::set<FactorId>& names)
{
  const OdometryUncertainty odometry(graph, names);
  const auto measured = [&](FactorId id) {
    return measuredLoop(
        graph, id, std::get<BetweenFactor>(graph.factor(id).measurement));
  };
  std::vector<std::pair<std::size_t, FactorId>> lengths;
  for (const FactorId id : names) {
    const MeasuredLoop loop = measured(id);
    const std::size_t from = odometry.indexOf(loop.from);
    const std::size_t to = odometry.indexOf(loop.to);
    if (odometry.motion(loop.from, loop.to))
      lengths.emplace_back(std::max(from, to) - std::min(from, to), id);
  }
  std::sort(lengths.begin(), lengths.end());
  std::vector<MeasuredLoop> loops;
  for (const auto& [length, id] : lengths)
    loops.push_back(measured(id));
  return loops;
}

double
lowerQuartile(std::vector<double> values)
{
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/** d^2 of the rotation or the translation alone, in units of its lower quartile. */
double
relativeDistance(const CycleError& cycle, bool planar, bool rotation)
{
  const Eigen::Index first = rotation ? (planar ? 5 : 3) : 0;
  const Eigen::Index size = planar ? (rotation ? 1 : 2) : 3;
  const Eigen::VectorXd error = cycle.error.segment(first, size);
  const Eigen::MatrixXd covariance = cycle.covariance.block(first, first, size, size);
  return error.dot(covariance.ldlt().solve(error)) /
         chiSquareQuantile(static_cast<int>(size), 0.25);
}

class ScaleSearch {
public:
  ScaleSearch(const PoseGraph& graph, const std::set<FactorId>& names)
      : graph_(graph), names_(names), loops_(loopsByLength(graph, names))
  {
  }

  bool
  hasEnough() const
  {
    constexpr std::size_t kFewest = 20;
    return loops_.size() >= kFewest;
  }

  NoiseScale
  run() const
  {
    NoiseScale scale;
    scale.rotation = std::clamp(std::sqrt(quartile(scale, true)), kSmallestScale, 1.0);
    double low = std::log(scale.rotation);
    double high = 0.0;
    for (int k = 0; k < 20; ++k) {
      const double middle = 0.5 * (low + high);
      scale.translation = std::exp(middle);
      (quartile(scale, false) > 1.0 ? low : high) = middle;
    }
    return scale;
  }

private:
  /** Lower quartile of the distances, in units of what it should be. */
  double
  quartile(const NoiseScale& scale, bool rotation) const
  {
    const OdometryUncertainty odometry(graph_, names_, scale);
    std::vector<double> distances;
    for (MeasuredLoop loop : loops_) {
      loop.measured.covariance = scale.applyTo(loop.measured.covariance);
      distances.push_back(
          relativeDistance(*cycleError(loop, odometry), loop.planar, rotation));
    }
    const double all = lowerQuartile(distances);
    distances.resize(distances.size() / 2);
    return std::min(all, lowerQuartile(std::move(distances)));
  }

  const PoseGraph& graph_;
  const std::set<FactorId>& names_;
  std::vector<MeasuredLoop> loops_;
};

} // namespace

NoiseScale
estimateNoiseScale(const PoseGraph& graph, const std::set<FactorId>& loops)
{
  const ScaleSearch search(graph, loops);
  if (!search.hasEnough())
    return {};
  constexpr double kTails = 2.0;
  const NoiseScale middle = search.run();
  return {std::min(1.0, kTails * middle.translation),
          std::min(1.0, kTails * middle.rotation)};
}

} // namespace nurbs
} // namespace pcl
