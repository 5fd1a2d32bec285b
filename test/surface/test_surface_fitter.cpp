// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "fit_points.h"

#include <pcl/surface/nurbs/knot_operations.h>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

SurfaceFitOptions
optionsFor(FitDistance distance)
{
  SurfaceFitOptions options;
  options.distance = distance;
  return options;
}

/** Every 8th point far off the surface, all on one side. */
void
addOutliers(FitPoints& points)
{
  for (Eigen::Index k = 0; k < points.positions.cols(); k += 8)
    points.positions(2, k) += 0.05 + 0.2 * std::abs(points.positions(0, k));
}

TEST(SurfaceFitter, HeldOutErrorIsTheNoise)
{
  FitPoints points = scattered(wave, 20000, 1);
  addNoise(points, 0.002, 2);
  const KnotVector knots = KnotVector::clampedUniform(3, 6, -1, 1);
  SurfaceFitOptions options;
  options.hold_out_every = 7;
  const SurfaceFit fit =
      fitHeightField(HeightFieldFrame(), knots, knots, points, options);
  EXPECT_TRUE(fit.report.converged);
  EXPECT_EQ(fit.report.held_out_points, 20000 / 7);
  EXPECT_EQ(fit.report.fitted_points, 20000 - 20000 / 7);
  // Orthogonal distances are shorter than heights by the cosine of the slope.
  EXPECT_NEAR(fit.report.held_out_rmse, 0.002 * 0.88, 0.0002);
  EXPECT_NEAR(fit.report.held_out_p95, 1.96 * 0.002 * 0.88, 0.0004);
  EXPECT_LT(waveRms(fit.surface), 2.5e-4);
}

TEST(SurfaceFitter, RobustLossesIgnoreOutliers)
{
  const KnotVector knots = KnotVector::clampedUniform(3, 6, -1, 1);
  FitPoints points = scattered(wave, 20000, 4);
  addNoise(points, 0.002, 5);
  addOutliers(points);
  for (FitDistance distance : {FitDistance::Parametric, FitDistance::Orthogonal}) {
    SurfaceFitOptions options = optionsFor(distance);
    const double plain = waveRms(
        fitHeightField(HeightFieldFrame(), knots, knots, points, options).surface);
    EXPECT_GT(plain, 0.01);
    for (RobustLoss loss : {RobustLoss::Huber, RobustLoss::Cauchy, RobustLoss::Tukey}) {
      options.loss = loss;
      const SurfaceFit fit =
          fitHeightField(HeightFieldFrame(), knots, knots, points, options);
      EXPECT_LT(waveRms(fit.surface), loss == RobustLoss::Huber ? 2e-3 : 5e-4)
          << static_cast<int>(loss);
    }
  }
}

/** A steep ridge, sampled evenly over its surface, noise along its normals. */
FitPoints
steepRidge(double sigma)
{
  std::mt19937_64 engine(6);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> normal(0.0, sigma);
  FitPoints points;
  points.positions.resize(3, 20000);
  points.parameters.resize(2, 20000);
  for (Eigen::Index k = 0; k < points.positions.cols(); ++k) {
    const double x = uniform(engine);
    const double y = uniform(engine);
    const double slope = 6.0 * std::cos(4.0 * x);
    points.positions.col(k) =
        Eigen::Vector3d(x, y, 1.5 * std::sin(4.0 * x)) +
        normal(engine) * Eigen::Vector3d(-slope, 0.0, 1.0).normalized();
    points.parameters.col(k) = points.positions.col(k).head<2>();
  }
  points.sigma.setConstant(20000, sigma);
  return points;
}

TEST(SurfaceFitter, OrthogonalDistanceBeatsParametricOnSteepSurfaces)
{
  const FitPoints points = steepRidge(0.02);
  const KnotVector u = KnotVector::clampedUniform(3, 8, -1.1, 1.1);
  const KnotVector v = KnotVector::bezier(1, -1.1, 1.1);
  const auto error = [&](FitDistance distance) {
    const SurfaceFit fit =
        fitHeightField(HeightFieldFrame(), u, v, points, optionsFor(distance));
    return heightRms(subSurface(fit.surface, -1.0, 1.0, -1.0, 1.0),
                     [](double x, double) { return 1.5 * std::sin(4.0 * x); });
  };
  EXPECT_LT(error(FitDistance::Orthogonal), 0.5 * error(FitDistance::Parametric));
}

TEST(SurfaceFitter, PlaneSeenByACameraNeedsFourControlPoints)
{
  const HeightFieldFrame frame =
      HeightFieldFrame::perspective(525.0, 520.0, 319.5, 239.5);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.5, -0.3, -1.0).normalized();
  FitPoints points;
  points.positions.resize(3, 48 * 64);
  for (int k = 0; k < 48 * 64; ++k) {
    const Eigen::Vector3d ray(
        (10 * (k % 64) - 319.5) / 525.0, (10 * (k / 64) - 239.5) / 520.0, 1.0);
    points.positions.col(k) = ray * (-2.0 / normal.dot(ray));
  }
  FitReport report;
  const auto knots = chooseHeightFieldKnots(frame, points, {}, report);
  for (FitDistance distance : {FitDistance::Parametric, FitDistance::Orthogonal}) {
    const SurfaceFit fit =
        fitHeightField(frame, knots.first, knots.second, points, optionsFor(distance));
    EXPECT_EQ(fit.surface.numControlPoints(), 4);
    EXPECT_TRUE(fit.surface.isRational());
    EXPECT_LT(fit.report.max, 1e-9);
  }
}

TEST(SurfaceFitter, BordersContinueTheirNeighbour)
{
  FitPoints left = scattered(wave, 8000, 7);
  FitPoints right =
      scattered([](double u, double v) { return wave(u + 2.0, v); }, 8000, 8);
  addNoise(left, 0.01, 7);
  addNoise(right, 0.01, 8);
  const KnotVector knots = KnotVector::clampedUniform(3, 4, -1, 1);
  const NurbsSurface first =
      fitParametric(knots, knots, left, optionsFor(FitDistance::Parametric)).surface;
  for (FitDistance distance :
       {FitDistance::Parametric, FitDistance::Alternating, FitDistance::Orthogonal})
    for (Continuity continuity : {Continuity::C0, Continuity::G1}) {
      const SurfaceFit second =
          fitParametric(knots,
                        knots,
                        right,
                        optionsFor(distance),
                        {{Border::UMin, first, Border::UMax, continuity}});
      const double u = second.surface.knotsU().domainMin();
      for (int k = 0; k <= 50; ++k) {
        const double v = -1.0 + 2.0 * k / 50.0;
        if (distance == FitDistance::Orthogonal && u < -1.0)
          continue; // the domain was extended past the common border
        const SurfaceJet1 a = first.evaluateJet1(1.0, v);
        const SurfaceJet1 b = second.surface.evaluateJet1(-1.0, v);
        EXPECT_LT((a.position - b.position).norm(), 1e-12);
        if (continuity == Continuity::G1) {
          EXPECT_LT(
              a.du.cross(a.dv).normalized().cross(b.du.cross(b.dv).normalized()).norm(),
              1e-12);
        }
      }
    }
}

TEST(SurfaceFitter, BadInputIsRefused)
{
  const KnotVector knots = KnotVector::bezier(1, -1, 1);
  const HeightFieldFrame frame;
  const FitPoints good = scattered(wave, 100, 9);
  const auto refused = [&](const FitPoints& points, const SurfaceFitOptions& options) {
    EXPECT_THROW(fitHeightField(frame, knots, knots, points, options),
                 std::invalid_argument);
  };
  refused(FitPoints(), {});
  FitPoints bad = good;
  bad.positions(1, 50) = std::numeric_limits<double>::quiet_NaN();
  refused(bad, {});
  bad = good;
  bad.sigma.setZero(100);
  refused(bad, {});
  bad.sigma.setConstant(100, -1.0);
  refused(bad, {});
  bad.sigma.setOnes(99);
  refused(bad, {});
  SurfaceFitOptions options;
  options.threads = 0;
  refused(good, options);
  options = {};
  options.hold_out_every = 1;
  refused(good, options);
  bad = good;
  bad.parameters.resize(2, 0);
  EXPECT_THROW(fitParametric(knots, knots, bad, {}), std::invalid_argument);
}

TEST(SurfaceFitter, WhatPointsDoNotTellIsReported)
{
  FitPoints corner = scattered(wave, 500, 11, 0.2);
  const KnotVector knots = KnotVector::clampedUniform(3, 8, -1, 1);
  const SurfaceFit fit = fitParametric(knots, knots, corner, {});
  EXPECT_GT(fit.report.undetermined, 40);
  EXPECT_TRUE(fit.surface.homogeneousPoints().allFinite());
  EXPECT_LT(fit.report.rmse, 1e-3);

  // Parameters that turn back make a surface that folds over.
  FitPoints folded = scattered(wave, 2000, 12);
  folded.positions.row(0) = folded.positions.row(0).cwiseAbs().eval();
  folded.positions.row(2).setZero();
  const KnotVector two = KnotVector::clampedUniform(2, 2, -1, 1);
  const SurfaceFit fold =
      fitParametric(two, two, folded, optionsFor(FitDistance::Parametric));
  EXPECT_GT(fold.report.foldovers, 0);
  EXPECT_NE(fold.report.message.find("folds over"), std::string::npos);

  SurfaceFitOptions hurried;
  hurried.max_iterations = 1;
  hurried.tolerance = 0.0;
  hurried.distance = FitDistance::Alternating;
  const SurfaceFit unfinished = fitParametric(knots, knots, corner, hurried);
  EXPECT_FALSE(unfinished.report.converged);
  EXPECT_FALSE(unfinished.report.message.empty());
}

TEST(SurfaceFitter, AnyScaleWillDo)
{
  for (double scale : {1e-6, 1.0, 1e6}) {
    FitPoints points = scattered(wave, 5000, 13);
    addNoise(points, 0.002, 13);
    points.positions *= scale;
    points.sigma *= scale;
    FitReport report;
    const auto knots = chooseHeightFieldKnots(HeightFieldFrame(), points, {}, report);
    const SurfaceFit fit =
        fitHeightField(HeightFieldFrame(), knots.first, knots.second, points, {});
    EXPECT_LT(
        waveRms(fit.surface.transformed(Eigen::Affine3d(Eigen::Scaling(1.0 / scale)))),
        4e-4)
        << scale;
  }
}

} // namespace
