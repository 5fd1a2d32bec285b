// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "loop_clusters.h"

#include <boost/pending/disjoint_sets.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kNeighbours = 16; // of a loop, that it is compared with

template <typename Matrix>
double
logDeterminantOf(const Matrix& covariance)
{
  return covariance.ldlt().vectorD().array().log().sum();
}

double
logDeterminant(const TangentMatrix& covariance, bool planar)
{
  return planar ? logDeterminantOf(planarPart(covariance))
                : logDeterminantOf(covariance);
}

/** Logarithm of a normal density at an error, but for its constant. */
double
logDensity(const CycleError& cycle, bool planar)
{
  return -0.5 * (squaredDistance(cycle.error, cycle.covariance, planar) +
                 logDeterminant(cycle.covariance, planar));
}

struct Link {
  double ratio; // logarithm of the likelihoods'
  std::size_t first;
  std::size_t second;
};

class Linker {
public:
  Linker(const std::vector<MeasuredLoop>& loops, const OdometryUncertainty& odometry)
      : loops_(loops), odometry_(odometry)
  {
    for (const MeasuredLoop& loop : loops) {
      const std::size_t from = odometry.indexOf(loop.from);
      const std::size_t to = odometry.indexOf(loop.to);
      ends_.emplace_back(std::min(from, to), std::max(from, to));
    }
  }

  /** Pairs that confirm each other, the surest first. */
  std::vector<Link>
  links(double least_ratio) const
  {
    std::vector<Link> result;
    for (std::size_t k = 0; k < loops_.size(); ++k)
      for (const std::size_t other : nearest(k)) {
        const double ratio = logRatio(loops_[k], loops_[other]);
        if (ratio >= least_ratio)
          result.push_back({ratio, k, other});
      }
    std::stable_sort(result.begin(), result.end(), [](const Link& a, const Link& b) {
      return a.ratio > b.ratio;
    });
    return result;
  }

private:
  /** Loops whose ends are nearest to those of one along the odometry. */
  std::vector<std::size_t>
  nearest(std::size_t loop) const
  {
    const auto gap = [](std::size_t a, std::size_t b) {
      return std::max(a, b) - std::min(a, b);
    };
    std::vector<std::pair<std::size_t, std::size_t>> order;
    order.reserve(loops_.size());
    for (std::size_t k = 0; k < loops_.size(); ++k)
      if (k != loop)
        order.emplace_back(gap(ends_[k].first, ends_[loop].first) +
                               gap(ends_[k].second, ends_[loop].second),
                           k);
    const std::size_t count = std::min(kNeighbours, order.size());
    std::partial_sort(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
    std::vector<std::size_t> result(count);
    std::transform(order.begin(),
                   order.begin() + static_cast<std::ptrdiff_t>(count),
                   result.begin(),
                   [](const auto& entry) { return entry.second; });
    return result;
  }

  double
  logRatio(const MeasuredLoop& a, const MeasuredLoop& b) const
  {
    const auto cycle = pairError(a, b, odometry_);
    const auto expected = odometry_.motion(a.from, a.to);
    if (!cycle || !expected)
      return -std::numeric_limits<double>::infinity();
    const CycleError unrelated{cycle->error, cycle->covariance + expected->covariance};
    return logDensity(*cycle, a.planar) - logDensity(unrelated, a.planar);
  }

  const std::vector<MeasuredLoop>& loops_;
  const OdometryUncertainty& odometry_;
  std::vector<std::pair<std::size_t, std::size_t>> ends_; // the earlier one first
};

/** Evidence of the best known loop of each cluster. */
double
bestEvidence(const LoopCluster& cluster,
             const std::vector<MeasuredLoop>& loops,
             const OdometryUncertainty& odometry)
{
  double best = -std::numeric_limits<double>::infinity();
  for (const std::size_t k : cluster.members)
    best = std::max(best, -0.5 * vagueness(loops[k], *cycleError(loops[k], odometry)));
  return best;
}

} // namespace

double
vagueness(const MeasuredLoop& loop, const CycleError& cycle)
{
  return logDeterminant(cycle.covariance, loop.planar) -
         logDeterminant(loop.measured.covariance, loop.planar);
}

std::vector<LoopCluster>
clusterLoops(const std::vector<MeasuredLoop>& loops,
             const OdometryUncertainty& odometry,
             double probability)
{
  boost::disjoint_sets_with_storage<> sets(loops.size());
  std::vector<double> tree(loops.size(), 0.0); // of links, at each representative
  const double least_ratio =
      std::log(static_cast<double>(kNeighbours) / (1.0 - probability));
  for (const Link& link : Linker(loops, odometry).links(least_ratio)) {
    const std::size_t a = sets.find_set(link.first);
    const std::size_t b = sets.find_set(link.second);
    if (a == b)
      continue;
    sets.link(a, b);
    tree[sets.find_set(a)] = tree[a] + tree[b] + link.ratio;
  }
  std::map<std::size_t, LoopCluster> clusters;
  for (std::size_t k = 0; k < loops.size(); ++k)
    clusters[sets.find_set(k)].members.push_back(k);
  std::vector<LoopCluster> result;
  for (auto& [representative, cluster] : clusters) {
    cluster.confirmation = tree[representative];
    cluster.evidence = cluster.confirmation + bestEvidence(cluster, loops, odometry);
    result.push_back(std::move(cluster));
  }
  std::stable_sort(
      result.begin(), result.end(), [](const LoopCluster& a, const LoopCluster& b) {
        return a.evidence > b.evidence;
      });
  return result;
}

} // namespace nurbs
} // namespace pcl
