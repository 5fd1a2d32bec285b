// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Closest points of the 34 x 34 bicubic surface, against SISL.

#include <pcl/surface/nurbs/closest_point.h>

#include "measure.h"
#include "sisl_evaluator.h"
#include "wave.h"

#include <benchmark/benchmark.h>

#include <limits>
#include <random>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::bench;
using benchmark::State;

/** Query points, and a parameter near the foot of each: rows x y z u v. */
using Queries = Eigen::Matrix<double, 5, Eigen::Dynamic>;

constexpr double kGuessError = 0.01;

/** Points up to \a reach above or below the surface over all of its domain. */
Queries
makeQueries(const NurbsSurface& surface, int count, double reach)
{
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Queries queries(5, count);
  for (auto&& query : queries.colwise()) {
    const double u = unit(engine);
    const double v = unit(engine);
    const Eigen::Vector3d offset = reach * unit(engine) * surface.normal(u, v);
    query.head<3>() = surface.evaluate(u, v) + offset;
    query(3) = surface.knotsU().clampToDomain(u + kGuessError * unit(engine));
    query(4) = surface.knotsV().clampToDomain(v + kGuessError * unit(engine));
  }
  return queries;
}

double
bruteForceDistance(const Eigen::Matrix3Xd& grid, const Eigen::Vector3d& point)
{
  return std::sqrt((grid.colwise() - point).colwise().squaredNorm().minCoeff());
}

Eigen::Matrix3Xd
sampleGrid(const NurbsSurface& surface, int steps)
{
  Eigen::Matrix3Xd grid(3, (steps + 1) * (steps + 1));
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      grid.col(i * (steps + 1) + j) =
          surface.evaluate(-1.0 + 2.0 * i / steps, -1.0 + 2.0 * j / steps);
  return grid;
}

/** Share of the queries whose distance no point of a dense grid undercuts. */
template <typename Distance>
double
globalPercent(const NurbsSurface& surface, const Queries& queries, Distance distance)
{
  const Eigen::Matrix3Xd grid = sampleGrid(surface, 300);
  int global = 0;
  for (const auto& query : queries.colwise())
    if (distance(query) <= bruteForceDistance(grid, query.head<3>()) + 1e-9)
      ++global;
  return 100.0 * global / static_cast<double>(queries.cols());
}

/** Time distance(query); quality is checked on fewer queries than are timed. */
template <typename Distance>
void
measureDistance(State& state, const Queries& queries, Distance distance)
{
  const Eigen::Index checked = std::min<Eigen::Index>(queries.cols(), 500);
  state.counters["global_percent"] =
      globalPercent(waveSurface(), queries.leftCols(checked), distance);
  measureCalls(state, queries, distance);
}

Queries
warmQueries()
{
  return makeQueries(waveSurface(), 2000, 0.02);
}

Queries
globalQueries()
{
  return makeQueries(waveSurface(), 500, 0.5);
}

void
warm(State& state)
{
  const ClosestPointFinder finder(waveSurface());
  measureDistance(state, warmQueries(), [&](const auto& query) {
    return finder.findFrom(query.template head<3>(), query(3), query(4)).distance;
  });
}

void
global(State& state)
{
  const ClosestPointFinder finder(waveSurface());
  measureDistance(state, globalQueries(), [&](const auto& query) {
    return finder.find(query.template head<3>()).distance;
  });
}

void
buildFinder(State& state)
{
  const NurbsSurface surface = waveSurface();
  for (auto _ : state)
    benchmark::DoNotOptimize(ClosestPointFinder(surface));
}

BENCHMARK(warm)->Name("closest_point_warm/ours");
BENCHMARK(global)->Name("closest_point_global/ours");
BENCHMARK(buildFinder)->Name("closest_point_build/ours");

#ifdef PCL_NURBS_HAVE_SISL
constexpr double kTolerance = 1e-10;

void
sislWarm(State& state)
{
  const NurbsSurface surface = waveSurface();
  const SislSurface peer = toSisl(surface);
  double low[2] = {-1.0, -1.0};
  double high[2] = {1.0, 1.0};
  measureDistance(state, warmQueries(), [&](const auto& query) {
    Eigen::Vector3d point = query.template head<3>();
    double guess[2] = {query(3), query(4)};
    double foot[2];
    int status = 0;
    s1775(peer.get(), point.data(), 3, kTolerance, low, high, guess, foot, &status);
    checkSisl(status, "s1775");
    return (surface.evaluate(foot[0], foot[1]) - point).norm();
  });
}

void
sislGlobal(State& state)
{
  const SislSurface peer = toSisl(waveSurface());
  measureDistance(state, globalQueries(), [&](const auto& query) {
    Eigen::Vector3d point = query.template head<3>();
    double foot[2];
    double distance = std::numeric_limits<double>::infinity();
    int status = 0;
    s1958(peer.get(), point.data(), 3, 0.0, kTolerance, foot, &distance, &status);
    checkSisl(status, "s1958");
    return distance;
  });
}

BENCHMARK(sislWarm)->Name("closest_point_warm/SISL");
BENCHMARK(sislGlobal)->Name("closest_point_global/SISL");
#endif

} // namespace
