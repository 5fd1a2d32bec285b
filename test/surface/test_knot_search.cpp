// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "fit_points.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

using Knots = std::pair<KnotVector, KnotVector>;

Knots
search(const FitPoints& points, const KnotSearchOptions& options = {})
{
  FitReport report;
  return chooseHeightFieldKnots(HeightFieldFrame(), points, options, report);
}

int
controlPoints(const Knots& knots)
{
  return knots.first.numControlPoints() * knots.second.numControlPoints();
}

Eigen::Vector3d
tiltedPlane(double u, double v)
{
  return {u, v, 0.3 * u - 0.2 * v};
}

TEST(KnotSearch, NoisyWaveIsSmallAndTrue)
{
  FitPoints points = scattered(wave, 100000, 1);
  addNoise(points, 0.002, 2);
  const Knots knots = search(points);
  EXPECT_LE(controlPoints(knots), 90);
  const SurfaceFit fit =
      fitHeightField(HeightFieldFrame(), knots.first, knots.second, points, {});
  EXPECT_LE(waveRms(fit.surface), 0.08e-3);
}

TEST(KnotSearch, StatedNoiseHardlyMatters)
{
  FitPoints points = scattered(wave, 100000, 3);
  addNoise(points, 0.002, 4);
  std::vector<int> counts;
  for (double factor : {1.0, 2.0, 3.0, 4.0}) {
    points.sigma.setConstant(points.positions.cols(), factor * 0.002);
    counts.push_back(controlPoints(search(points)));
  }
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  EXPECT_LE(*most - *least, 0.2 * *most);
}

TEST(KnotSearch, NoisyPlanesHaveFourControlPoints)
{
  constexpr int kSeeds = 100;
  int four = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    FitPoints points = scattered(tiltedPlane, 3000, static_cast<unsigned>(seed));
    addNoise(points, 0.005, static_cast<unsigned>(seed) + 1000);
    four += controlPoints(search(points)) == 4 ? 1 : 0;
  }
  EXPECT_GE(four, 95);
}

TEST(KnotSearch, PlanesWithoutNoiseHaveFourControlPoints)
{
  EXPECT_EQ(controlPoints(search(scattered(tiltedPlane, 3000, 5))), 4);
  FitReport report;
  const Knots knots =
      chooseParametricKnots(scattered(tiltedPlane, 3000, 6), {}, report);
  EXPECT_EQ(controlPoints(knots), 4);
}

TEST(KnotSearch, PolynomialsWithoutNoiseKeepTheirDegree)
{
  const auto cubic = [](double u, double v) {
    return Eigen::Vector3d(u, v, u * u * u - 0.5 * u + 0.4 * v * v);
  };
  const Knots knots = search(scattered(cubic, 5000, 7));
  EXPECT_LE(controlPoints(knots), 24);
  SurfaceFitOptions options;
  options.distance = FitDistance::Parametric;
  options.fairness = 0.0;
  const SurfaceFit fit = fitHeightField(HeightFieldFrame(),
                                        knots.first,
                                        knots.second,
                                        scattered(cubic, 5000, 7),
                                        options);
  EXPECT_LT(fit.report.max, 1e-9);
}

TEST(KnotSearch, KnotsGoToTheCrease)
{
  FitPoints points = scattered(
      [](double u, double v) { return Eigen::Vector3d(u, v, std::abs(u - 0.25)); },
      40000,
      8);
  addNoise(points, 0.002, 9);
  const Knots knots = search(points);
  const std::vector<double> breaks = knots.first.breaks();
  const auto nearest =
      std::min_element(breaks.begin(), breaks.end(), [](double a, double b) {
        return std::abs(a - 0.25) < std::abs(b - 0.25);
      });
  EXPECT_NEAR(*nearest, 0.25, 0.05);
  EXPECT_EQ(knots.second.numControlPoints(), 2); // nothing happens along v
}

TEST(KnotSearch, VectorValuesFindTheSameStructure)
{
  FitPoints points = scattered(wave, 30000, 10);
  addNoise(points, 0.002, 11);
  FitReport report;
  const Knots knots = chooseParametricKnots(points, {}, report);
  EXPECT_LE(controlPoints(knots), 100);
  SurfaceFitOptions options;
  options.distance = FitDistance::Parametric;
  const SurfaceFit fit = fitParametric(knots.first, knots.second, points, options);
  EXPECT_LT(waveRms(fit.surface), 0.3e-3);
}

TEST(KnotSearch, CriteriaAndLimitsAreKept)
{
  FitPoints points = scattered(wave, 20000, 12);
  addNoise(points, 0.002, 13);
  for (ModelCriterion criterion : {ModelCriterion::AIC,
                                   ModelCriterion::AICc,
                                   ModelCriterion::BIC,
                                   ModelCriterion::KnownNoise}) {
    KnotSearchOptions options;
    options.criterion = criterion;
    const Knots knots = search(points, options);
    EXPECT_GE(controlPoints(knots), 20) << static_cast<int>(criterion);
    EXPECT_LE(controlPoints(knots), 120) << static_cast<int>(criterion);
    options.max_control_points = 12;
    EXPECT_LE(controlPoints(search(points, options)), 12);
    options.max_control_points = 1024;
    options.degree_u = 3;
    options.degree_v = 2;
    const Knots fixed = search(points, options);
    EXPECT_EQ(fixed.first.degree(), 3);
    EXPECT_EQ(fixed.second.degree(), 2);
  }
}

TEST(KnotSearch, FewAndDegeneratePointsGiveSmallNets)
{
  for (int count : {1, 2, 3, 4, 5, 8, 15, 30}) {
    FitPoints points = scattered(tiltedPlane, count, 14);
    addNoise(points, 0.005, 15);
    EXPECT_LE(controlPoints(search(points)), std::max(4, count)) << count;
  }
  FitPoints line =
      scattered([](double u, double) { return Eigen::Vector3d(u, 0, 0); }, 500, 16);
  EXPECT_EQ(controlPoints(search(line)), 4);
  FitPoints same =
      scattered([](double, double) { return Eigen::Vector3d(1, 2, 3); }, 500, 17);
  EXPECT_EQ(controlPoints(search(same)), 4);
}

TEST(KnotSearch, SearchIsDeterministic)
{
  FitPoints points = scattered(wave, 20000, 18);
  addNoise(points, 0.002, 19);
  const Knots one = search(points);
  const Knots two = search(points);
  EXPECT_EQ(one.first, two.first);
  EXPECT_EQ(one.second, two.second);
}

} // namespace
