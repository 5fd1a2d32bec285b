// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Fits of a 34 x 34 surface to noisy samples; quality is the distance to the truth,
// which no fit has seen.

#include "wave.h"

#include <benchmark/benchmark.h>

#ifdef PCL_NURBS_HAVE_ALGLIB
#include <libalglib/interpolation.h>
#endif

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::bench;
using benchmark::State;

/** Time \a fit(samples), whose result is callable as (u, v) -> point. */
template <typename Fit, typename Samples>
void
measure(State& state, const Samples& samples, Fit fit)
{
  double rms = 0.0;
  for (auto _ : state) {
    const auto surface = fit(samples);
    state.PauseTiming();
    rms = truthRms(surface);
    state.ResumeTiming();
  }
  state.counters["truth_rms_mm"] = 1e3 * rms;
}

#ifdef PCL_NURBS_HAVE_ALGLIB
/** Bicubic height field, the kind of surface this builder makes. */
auto
fitBlockLls(const alglib::real_2d_array& samples)
{
  alglib::spline2dbuilder builder;
  alglib::spline2dbuildercreate(1, builder);
  alglib::spline2dbuildersetpoints(builder, samples, samples.rows());
  alglib::spline2dbuildersetarea(builder, -1.0, 1.0, -1.0, 1.0);
  alglib::spline2dbuildersetgrid(builder, kNet, kNet);
  alglib::spline2dbuildersetalgoblocklls(builder, 1e-6);
  alglib::spline2dinterpolant height;
  alglib::spline2dfitreport report;
  alglib::spline2dfit(builder, height, report);
  return [height](double x, double y) {
    return Eigen::Vector3d(x, y, alglib::spline2dcalc(height, x, y));
  };
}

void
alglibBlockLls(State& state)
{
  const Eigen::Matrix3Xd samples = waveSamples(static_cast<int>(state.range(0)));
  alglib::real_2d_array rows;
  rows.setcontent(samples.cols(), 3, samples.data());
  measure(state, rows, fitBlockLls);
}

BENCHMARK(alglibBlockLls)
    ->Name("fit_one_pass/ALGLIB")
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kMillisecond);
#endif

} // namespace
