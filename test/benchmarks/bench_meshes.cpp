// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Triangles of a trimmed surface, and evaluation of many parameters at once.

#include "wave.h"

#include <pcl/surface/nurbs/batch_evaluation.h>
#include <pcl/surface/nurbs/tessellation.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::bench;
using benchmark::State;

/** The wave inside of a circle, with triangles as small as a 256 x 256 grid's. */
void
tessellateTrimmed(State& state)
{
  constexpr int kCorners = 400;
  constexpr double kRadius = 0.9;
  std::vector<Eigen::Vector2d> circle;
  for (int k = 0; k < kCorners; ++k)
    circle.emplace_back(kRadius * std::cos(2.0 * M_PI * k / kCorners),
                        kRadius * std::sin(2.0 * M_PI * k / kCorners));
  const TrimmedSurface surface(waveSurface(), {TrimLoop::polygon(circle)});
  TessellationOptions options;
  options.chord_tolerance = 0.1; // the edge length decides
  options.max_edge_length = 2.0 / 256.0;
  std::size_t triangles = 0;
  for (auto _ : state)
    triangles = tessellate(surface, options).triangles.size();
  state.counters["triangles"] = static_cast<double>(triangles);
}

void
batchJets(State& state)
{
  constexpr int kCount = 100000;
  const NurbsSurface surface = waveSurface();
  const Eigen::Matrix2Xd uv = randomParameters(kCount);
  const Eigen::VectorXd u = uv.row(0);
  const Eigen::VectorXd v = uv.row(1);
  std::vector<double> out(9 * kCount);
  const auto arrays = [&](int k) {
    double* first = out.data() + 3 * k * kCount;
    return CoordinateArrays{first, first + kCount, first + 2 * kCount};
  };
  for (auto _ : state)
    evaluateJet1Batch(
        surface, kCount, u.data(), v.data(), arrays(0), arrays(1), arrays(2));
  state.counters["calls"] = kCount;
}

BENCHMARK(tessellateTrimmed)
    ->Name("tessellate_trimmed/ours")
    ->Unit(benchmark::kMillisecond);
BENCHMARK(batchJets)->Name("evaluate_jet1_batch/ours");

} // namespace
