// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Knot insertion and degree elevation of the 34 x 34 bicubic surface, against SISL.

#include <pcl/surface/nurbs/knot_operations.h>

#include "sisl_evaluator.h"
#include "wave.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::bench;
using benchmark::State;

/** Largest distance between two surfaces at the same parameters. */
template <typename Evaluate>
double
movement(const NurbsSurface& before, Evaluate after)
{
  const Eigen::Matrix2Xd parameters = randomParameters(500, 11);
  double largest = 0.0;
  for (const auto& uv : parameters.colwise())
    largest = std::max(
        largest, (before.evaluate(uv.x(), uv.y()) - after(uv.x(), uv.y())).norm());
  return largest;
}

/** Time \a change(surface) and note how far it moved the surface. */
template <typename Change>
void
measure(State& state, Change change)
{
  const NurbsSurface surface = waveSurface();
  const NurbsSurface changed = change(surface);
  state.counters["moved_m"] =
      movement(surface, [&](double u, double v) { return changed.evaluate(u, v); });
  for (auto _ : state)
    benchmark::DoNotOptimize(change(surface));
}

/** Sixteen knots that are not there yet. */
std::vector<double>
newKnots()
{
  std::vector<double> knots;
  for (int i = 0; i < 16; ++i)
    knots.push_back(-0.95 + 0.119 * i);
  return knots;
}

void
insertKnots(State& state)
{
  const std::vector<double> knots = newKnots();
  measure(state, [&](const NurbsSurface& surface) {
    return refineKnots(refineKnots(surface, Direction::U, knots), Direction::V, knots);
  });
}

void
elevate(State& state)
{
  measure(state, [](const NurbsSurface& surface) {
    return elevateDegree(elevateDegree(surface, Direction::U), Direction::V);
  });
}

BENCHMARK(insertKnots)->Name("insert_16x16_knots/ours");
BENCHMARK(elevate)->Name("elevate_degree_3_to_4/ours");

#ifdef PCL_NURBS_HAVE_SISL
/** Time \a change(SISL surface) -> SISL surface, and note how far it moved. */
template <typename Change>
void
measureSisl(State& state, Change change)
{
  const NurbsSurface surface = waveSurface();
  const SislSurface peer = toSisl(surface);
  SislEvaluator changed(change(peer.get()));
  state.counters["moved_m"] =
      movement(surface, [&](double u, double v) -> Eigen::Vector3d {
        return changed.evaluate<0>(u, v);
      });
  for (auto _ : state)
    benchmark::DoNotOptimize(change(peer.get()));
}

void
sislInsertKnots(State& state)
{
  std::vector<double> knots = newKnots();
  const int count = static_cast<int>(knots.size());
  measureSisl(state, [&](SISLSurf* surface) {
    SISLSurf* refined = nullptr;
    int status = 0;
    s1025(surface, knots.data(), count, knots.data(), count, &refined, &status);
    checkSisl(status, "s1025");
    return SislSurface(refined);
  });
}

void
sislElevate(State& state)
{
  measureSisl(state, [](SISLSurf* surface) {
    SISLSurf* elevated = nullptr;
    int status = 0;
    s1387(surface, 5, 5, &elevated, &status); // orders, degree + 1
    checkSisl(status, "s1387");
    return SislSurface(elevated);
  });
}

BENCHMARK(sislInsertKnots)->Name("insert_16x16_knots/SISL");
BENCHMARK(sislElevate)->Name("elevate_degree_3_to_4/SISL");
#endif

} // namespace
