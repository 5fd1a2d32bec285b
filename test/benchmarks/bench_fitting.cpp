// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Fits of a 34 x 34 surface to noisy samples; quality is the distance to the truth,
// which no fit has seen.

#include "wave.h"

#include <pcl/surface/nurbs/surface_fitter.h>

#include <benchmark/benchmark.h>

#ifdef PCL_NURBS_HAVE_ALGLIB
#include <libalglib/interpolation.h>
#endif

#include <utility>

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

constexpr int kThreads = 2;

FitPoints
wavePoints(int count)
{
  FitPoints points;
  points.positions = waveSamples(count);
  points.parameters = points.positions.topRows(2);
  points.sigma = Eigen::VectorXd::Constant(count, kNoise);
  return points;
}

KnotVector
netKnots()
{
  return KnotVector::clampedUniform(3, kNet - 3, -1.0, 1.0);
}

/** The surface as measure() wants it; parameters stay inside of the fitted domain,
 * which ends at the outermost samples where knots are chosen. */
auto
evaluator(NurbsSurface surface)
{
  return [surface = std::move(surface)](double u, double v) {
    return surface.evaluate(surface.knotsU().clampToDomain(u),
                            surface.knotsV().clampToDomain(v));
  };
}

/** Heights over the plane: the linear problem that ALGLIB solves as well. */
void
oursOnePass(State& state)
{
  SurfaceFitOptions options;
  options.distance = FitDistance::Parametric;
  options.measure = false;
  options.threads = kThreads;
  measure(
      state,
      wavePoints(static_cast<int>(state.range(0))),
      [&](const FitPoints& points) {
        return evaluator(
            fitHeightField(HeightFieldFrame(), netKnots(), netKnots(), points, options)
                .surface);
      });
}

/** x, y and z, with the parameters corrected until the cost is steady. */
void
oursFull(State& state)
{
  SurfaceFitOptions options;
  options.distance = FitDistance::Alternating;
  options.tolerance = 1e-4;
  options.measure = false;
  options.threads = kThreads;
  measure(state,
          wavePoints(static_cast<int>(state.range(0))),
          [&](const FitPoints& points) {
            return evaluator(
                fitParametric(netKnots(), netKnots(), points, options).surface);
          });
}

/** Degrees and knots are found as well; the noise is stated wrongly by a factor. */
void
oursAdaptive(State& state)
{
  FitPoints points = wavePoints(100000);
  points.sigma *= static_cast<double>(state.range(0));
  SurfaceFitOptions options;
  options.distance = FitDistance::Parametric;
  options.measure = false;
  options.threads = kThreads;
  int coefficients = 0;
  measure(state, points, [&](const FitPoints& samples) {
    FitReport report;
    const SurfaceKnots knots = chooseHeightFieldKnots(
        HeightFieldFrame(), samples, KnotSearchOptions(), report);
    SurfaceFit fit =
        fitHeightField(HeightFieldFrame(), knots.first, knots.second, samples, options);
    coefficients = fit.surface.numControlPoints();
    return evaluator(std::move(fit.surface));
  });
  state.counters["coefficients"] = coefficients;
}

BENCHMARK(oursOnePass)
    ->Name("fit_one_pass/ours")
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(oursFull)
    ->Name("fit_full_3d/ours")
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(oursAdaptive)
    ->Name("fit_adaptive/ours")
    ->Arg(1)
    ->Arg(2)
    ->Arg(4)
    ->Unit(benchmark::kMillisecond);

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
