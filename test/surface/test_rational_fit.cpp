// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Quadrics and tori have exact rational biquadratic patches: a fit of control points
// and weights has to find one.

#include "fit_points.h"

#include <gtest/gtest.h>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

constexpr double kHalf = 0.6;

Eigen::Vector3d
onSphere(double u, double v)
{
  return {u, v, std::sqrt(1.0 - u * u - v * v)};
}

Eigen::Vector3d
onCylinder(double u, double v)
{
  return {std::sin(u), v, std::cos(u)};
}

Eigen::Vector3d
onTorus(double u, double v)
{
  const double r = 3.0 + std::cos(v);
  return {r * std::cos(u), r * std::sin(u), std::sin(v)};
}

/** Rational biquadratic fit that starts from the best polynomial one. */
SurfaceFit
fitPatch(const FitPoints& given)
{
  FitPoints points = given;
  const KnotVector knots = KnotVector::bezier(2, -kHalf, kHalf);
  SurfaceFitOptions options;
  options.distance = FitDistance::Parametric;
  const SurfaceFit start = fitParametric(knots, knots, points, options);
  points.parameters = start.parameters;
  options.fairness = 0.0;
  options.max_iterations = 60;
  options.tolerance = 1e-12;
  return fitRational(start.surface, points, options);
}

/** Largest distance of the part of the surface that has points. */
template <typename Distance>
double
largestDistance(const SurfaceFit& fit, Distance distance)
{
  double largest = 0.0;
  for (Eigen::Index k = 0; k < fit.parameters.cols(); ++k)
    largest = std::max(largest,
                       std::abs(distance(fit.surface.evaluate(fit.parameters(0, k),
                                                              fit.parameters(1, k)))));
  return largest;
}

TEST(RationalFit, SphereIsExact)
{
  for (unsigned seed : {1, 2, 3}) {
    const SurfaceFit fit = fitPatch(scattered(onSphere, 2000, seed, kHalf));
    EXPECT_LT(fit.report.max, 1e-9);
    EXPECT_LT(
        largestDistance(fit, [](const Eigen::Vector3d& p) { return p.norm() - 1.0; }),
        1e-9);
    EXPECT_TRUE(fit.surface.isRational());
  }
}

TEST(RationalFit, CylinderIsExact)
{
  for (unsigned seed : {1, 2, 3}) {
    const SurfaceFit fit = fitPatch(scattered(onCylinder, 2000, seed, kHalf));
    EXPECT_LT(fit.report.max, 1e-9);
    EXPECT_LT(largestDistance(fit,
                              [](const Eigen::Vector3d& p) {
                                return std::hypot(p.x(), p.z()) - 1.0;
                              }),
              1e-9);
  }
}

TEST(RationalFit, TorusIsExact)
{
  const auto distance = [](const Eigen::Vector3d& p) {
    return std::hypot(std::hypot(p.x(), p.y()) - 3.0, p.z()) - 1.0;
  };
  for (unsigned seed : {1, 2, 3}) {
    const SurfaceFit fit = fitPatch(scattered(onTorus, 2000, seed, kHalf));
    EXPECT_LT(fit.report.max, 1e-9);
    EXPECT_LT(largestDistance(fit, distance), 1e-9);
  }
}

TEST(RationalFit, NoiseEndsAtItsLevel)
{
  FitPoints points = scattered(onSphere, 4000, 5, kHalf);
  addNoise(points, 1e-3, 5);
  points.sigma.resize(0);
  const SurfaceFit fit = fitPatch(points);
  EXPECT_LT(fit.report.rmse, 1e-3);
  EXPECT_GT(fit.report.rmse, 0.7e-3); // along the normal, at most 45 degrees off z
}

} // namespace
