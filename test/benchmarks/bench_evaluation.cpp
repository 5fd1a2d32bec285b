// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Evaluation of a 34 x 34 surface at scattered parameters, against SISL.

#include "measure.h"
#include "sisl_evaluator.h"
#include "wave.h"

#include <benchmark/benchmark.h>

#include <algorithm>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::bench;
using benchmark::State;

/** The surfaces every row is measured on. */
void
surfaces(benchmark::internal::Benchmark* row)
{
  row->ArgNames({"degree", "rational"})->Args({3, 0})->Args({3, 1})->Args({5, 0});
}

NurbsSurface
requestedSurface(const State& state)
{
  return waveSurface(static_cast<int>(state.range(0)), state.range(1) != 0);
}

template <typename Evaluate>
void
measure(State& state, Evaluate evaluate)
{
  measureCalls(state, randomParameters(4096), [&](const auto& uv) {
    return evaluate(uv.x(), uv.y());
  });
}

void
point(State& state)
{
  const NurbsSurface surface = requestedSurface(state);
  measure(state, [&](double u, double v) { return surface.evaluate(u, v); });
}

void
jet1(State& state)
{
  const NurbsSurface surface = requestedSurface(state);
  measure(state, [&](double u, double v) { return surface.evaluateJet1(u, v); });
}

void
jet2(State& state)
{
  const NurbsSurface surface = requestedSurface(state);
  measure(state, [&](double u, double v) { return surface.evaluateJet2(u, v); });
}

BENCHMARK(point)->Name("evaluate_point/ours")->Apply(surfaces);
BENCHMARK(jet1)->Name("evaluate_jet1/ours")->Apply(surfaces);
BENCHMARK(jet2)->Name("evaluate_jet2/ours")->Apply(surfaces);

#ifdef PCL_NURBS_HAVE_SISL
/** Largest difference to our point and derivatives, relative to their size. */
template <int order>
double
difference(const NurbsSurface& surface, SislEvaluator& sisl)
{
  double largest = 0.0;
  const Eigen::Matrix2Xd parameters = randomParameters(500, 11);
  for (const auto& uv : parameters.colwise()) {
    const auto theirs = sisl.evaluate<order>(uv.x(), uv.y());
    const SurfaceDerivatives mine = surface.derivatives(uv.x(), uv.y(), order);
    int column = 0;
    for (int total = 0; total <= order; ++total)
      for (int l = 0; l <= total; ++l, ++column) {
        const Eigen::Vector3d& value = mine(total - l, l);
        largest = std::max(
            largest, (value - theirs.col(column)).norm() / std::max(1.0, value.norm()));
      }
  }
  return largest;
}

template <int order>
void
sisl(State& state)
{
  const NurbsSurface surface = requestedSurface(state);
  SislEvaluator evaluator(toSisl(surface));
  state.counters["difference"] = difference<order>(surface, evaluator);
  measure(state, [&](double u, double v) { return evaluator.evaluate<order>(u, v); });
}

BENCHMARK_TEMPLATE(sisl, 0)->Name("evaluate_point/SISL")->Apply(surfaces);
BENCHMARK_TEMPLATE(sisl, 1)->Name("evaluate_jet1/SISL")->Apply(surfaces);
BENCHMARK_TEMPLATE(sisl, 2)->Name("evaluate_jet2/SISL")->Apply(surfaces);
#endif

} // namespace
