// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <benchmark/benchmark.h>

#include <Eigen/Core>

namespace pcl {
namespace nurbs {
namespace bench {

/** \brief Time \a call(column) over all columns of \a inputs in each iteration. The
 * counter "calls" lets run_benchmarks.py report the time of one call. */
template <typename Inputs, typename Call>
void
measureCalls(benchmark::State& state, const Inputs& inputs, Call call)
{
  for (auto _ : state)
    for (Eigen::Index i = 0; i < inputs.cols(); ++i)
      benchmark::DoNotOptimize(call(inputs.col(i)));
  state.counters["calls"] = static_cast<double>(inputs.cols());
}

} // namespace bench
} // namespace nurbs
} // namespace pcl
