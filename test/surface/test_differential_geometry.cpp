// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/differential_geometry.h>

#include "exact_shapes.h"
#include "random_nurbs.h"
#ifdef PCL_NURBS_HAVE_SISL
#include "sisl_surface.h"
#endif

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;

constexpr double kPi = 3.14159265358979323846;

TEST(DifferentialGeometry, sphereIsUmbilicEverywhere)
{
  RandomNurbs random(51);
  const NurbsSurface sphere = test::sphere(2.0);
  for (int n = 0; n < 100; ++n) {
    const SurfaceCurvature c = curvature(
        sphere, random.inDomain(sphere.knotsU()), random.inDomain(sphere.knotsV()));
    EXPECT_TRUE(c.regular);
    EXPECT_NEAR(c.gaussian, 0.25, 1e-10);
    EXPECT_NEAR(std::abs(c.mean), 0.5, 1e-10);
  }
  for (const double pole : {0.0, 2.0})
    for (const double around : {0.0, 0.3, 1.3, 2.7}) {
      const SurfaceCurvature c = curvature(sphere, pole, around);
      EXPECT_FALSE(c.regular);
      EXPECT_NEAR(c.gaussian, 0.25, 1e-6);
      EXPECT_NEAR(std::abs(c.mean), 0.5, 1e-6);
    }
}

TEST(DifferentialGeometry, torusHasItsPrincipalCurvaturesAndDirections)
{
  RandomNurbs random(53);
  const NurbsSurface torus = test::torus(3.0, 1.0);
  for (int n = 0; n < 100; ++n) {
    const double u = random.inDomain(torus.knotsU());
    const double v = random.inDomain(torus.knotsV());
    const Eigen::Vector3d point = torus.evaluate(u, v);
    const double rho = point.head<2>().norm();
    const double around = (rho - 3.0) / rho; // cos of the tube angle over rho
    const FundamentalForms forms = fundamentalForms(torus, u, v);
    const Eigen::Vector3d outward =
        (point - 3.0 / rho * Eigen::Vector3d(point.x(), point.y(), 0)).normalized();
    const double sign = forms.normal.dot(outward) < 0.0 ? 1.0 : -1.0;
    const SurfaceCurvature c = curvature(torus, u, v);
    EXPECT_NEAR(c.gaussian, around, 1e-10);
    EXPECT_NEAR(c.mean, 0.5 * sign * (1.0 + around), 1e-10);
    EXPECT_NEAR(c.maximum * c.minimum, c.gaussian, 1e-10);
    EXPECT_LT((c.maximum_direction.cross(c.minimum_direction) - forms.normal).norm(),
              1e-12);
    // The curvature of the tube, of absolute value 1, is in its meridian plane.
    const Eigen::Vector3d tube = std::abs(c.maximum) > std::abs(c.minimum)
                                     ? c.maximum_direction
                                     : c.minimum_direction;
    EXPECT_NEAR(tube.dot(Eigen::Vector3d(-point.y(), point.x(), 0.0)), 0.0, 1e-8);
  }
}

TEST(DifferentialGeometry, formsAgreeWithFiniteDifferencesOfTheNormal)
{
  RandomNurbs random(57);
  const NurbsSurface surface = random.surface(3, 4, true, test::KnotKind::Bezier);
  const double h = 1e-5;
  for (int n = 0; n < 50; ++n) {
    const double u = random.inDomain(surface.knotsU());
    const double v = random.inDomain(surface.knotsV());
    const FundamentalForms f = fundamentalForms(surface, u, v);
    const SurfaceJet1 jet = surface.evaluateJet1(u, v);
    const Eigen::Vector3d n_u =
        (surface.normal(u + h, v) - surface.normal(u - h, v)) / (2 * h);
    const Eigen::Vector3d n_v =
        (surface.normal(u, v + h) - surface.normal(u, v - h)) / (2 * h);
    const double scale = 1e-6 * (1.0 + n_u.norm() + n_v.norm()) *
                         (1.0 + jet.du.squaredNorm() + jet.dv.squaredNorm());
    EXPECT_NEAR(f.l, -n_u.dot(jet.du), scale); // Weingarten
    EXPECT_NEAR(f.m, -n_u.dot(jet.dv), scale);
    EXPECT_NEAR(f.m, -n_v.dot(jet.du), scale);
    EXPECT_NEAR(f.n, -n_v.dot(jet.dv), scale);
    const SurfaceCurvature c = curvature(surface, u, v);
    const double area = f.e * f.g - f.f * f.f;
    EXPECT_NEAR(c.gaussian,
                (f.l * f.n - f.m * f.m) / area,
                1e-10 * (1.0 + std::abs(c.gaussian)));
    EXPECT_NEAR(c.mean,
                (f.e * f.n - 2 * f.f * f.m + f.g * f.l) / (2 * area),
                1e-10 * (1.0 + std::abs(c.mean)));
  }
}

TEST(DifferentialGeometry, aSurfaceShrunkToALineHasNoCurvature)
{
  const Eigen::Matrix3Xd points = (Eigen::Matrix3Xd(3, 4) << 0,
                                   1,
                                   1,
                                   2, //
                                   0,
                                   0,
                                   0,
                                   0, //
                                   0,
                                   0,
                                   0,
                                   0)
                                      .finished();
  const NurbsSurface line = NurbsSurface::fromControlPoints(
      KnotVector::bezier(1), KnotVector::bezier(1), points);
  const SurfaceCurvature c = curvature(line, 0.3, 0.4);
  EXPECT_FALSE(c.regular);
  EXPECT_EQ(c.gaussian, 0.0);
  EXPECT_TRUE(c.maximum_direction.isZero());
  EXPECT_TRUE(fundamentalForms(line, 0.3, 0.4).normal.isZero());
}

TEST(DifferentialGeometry, areasOfClosedForms)
{
  EXPECT_NEAR(surfaceArea(test::sphere(2.0)) / (16 * kPi), 1.0, 1e-9);
  EXPECT_NEAR(surfaceArea(test::cylinder(1.5, 3.0)) / (9 * kPi), 1.0, 1e-9);
  EXPECT_NEAR(surfaceArea(test::torus(3.0, 1.0), 1e-12) / (12 * kPi * kPi), 1.0, 1e-12);
  EXPECT_NEAR(surfaceArea(NurbsSurface()), 1.0, 1e-14);
  EXPECT_THROW(surfaceArea(NurbsSurface(), 0.0), std::invalid_argument);
}

TEST(DifferentialGeometry, curvesOfClosedForms)
{
  RandomNurbs random(59);
  const NurbsCurve3 circle(test::circleKnots(),
                           NurbsCurve3::HomogeneousPoints(test::circlePoints()));
  EXPECT_NEAR(arcLength(circle), 2 * kPi, 1e-8);
  EXPECT_NEAR(arcLength(circle, 1.0, 3.0), kPi, 1e-8);
  EXPECT_NEAR(arcLength(circle, 3.0, 1.0), -kPi, 1e-8);
  EXPECT_THROW(arcLength(circle, 0.0, 4.5), std::invalid_argument);
  for (int n = 0; n < 20; ++n) {
    const double u = random.inDomain(circle.knots());
    EXPECT_NEAR(curvature(circle, u), 1.0, 1e-11);
    EXPECT_NEAR(torsion(circle, u), 0.0, 1e-11);
  }
  // The twisted cubic (t, t^2, t^3): curvature and torsion are known in closed form.
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 1.0 / 3, 2.0 / 3, 1, //
      0, 0, 1.0 / 3, 1,             //
      0, 0, 0, 1;
  const NurbsCurve3 cubic =
      NurbsCurve3::fromControlPoints(KnotVector::bezier(3), points);
  for (const double t : {0.0, 0.3, 1.0}) {
    const double a = 1 + 9 * t * t + 9 * std::pow(t, 4);
    const double speed = std::sqrt(1 + 4 * t * t + 9 * std::pow(t, 4));
    EXPECT_NEAR(curvature(cubic, t), 2 * std::sqrt(a) / std::pow(speed, 3), 1e-12);
    EXPECT_NEAR(torsion(cubic, t), 3 / a, 1e-12);
  }
  Eigen::Matrix2Xd left(2, 3);
  left << 0, 1, 1, 0, 0, 1;
  const NurbsCurve2 turn = NurbsCurve2::fromControlPoints(KnotVector::bezier(2), left);
  EXPECT_GT(curvature(turn, 0.5), 0.0);
  EXPECT_NEAR(curvature(turn.reversed(), 0.5), -curvature(turn, 0.5), 1e-13);
}

#ifdef PCL_NURBS_HAVE_SISL
TEST(DifferentialGeometry, agreesWithSisl)
{
  RandomNurbs random(61);
  for (const bool rational : {false, true}) {
    const NurbsSurface surface =
        random.surface(3, 3, rational, test::KnotKind::ClampedRandom);
    const test::SislSurface sisl = test::toSisl(surface);
    for (int n = 0; n < 50; ++n) {
      double uv[2] = {random.inDomain(surface.knotsU()),
                      random.inDomain(surface.knotsV())};
      int left_u = 0;
      int left_v = 0;
      int status = 0;
      double d[18];
      double normal[3];
      s1421(sisl.get(), 2, uv, &left_u, &left_v, d, normal, &status);
      ASSERT_GE(status, 0);
      const SurfaceJet2 jet = surface.evaluateJet2(uv[0], uv[1]);
      const Eigen::Vector3d* ours[] = {
          &jet.position, &jet.du, &jet.dv, &jet.duu, &jet.duv, &jet.dvv};
      for (int k = 0; k < 6; ++k)
        EXPECT_LT((Eigen::Map<Eigen::Vector3d>(d + 3 * k) - *ours[k]).norm(),
                  1e-10 * (1.0 + ours[k]->norm()));
      double gaussian = 0.0;
      double mean = 0.0;
      s2500(sisl.get(), 0, 0, 0, uv, &left_u, &left_v, &gaussian, &status);
      ASSERT_GE(status, 0);
      s2502(sisl.get(), 0, 0, 0, uv, &left_u, &left_v, &mean, &status);
      ASSERT_GE(status, 0);
      const SurfaceCurvature c = curvature(surface, uv[0], uv[1]);
      EXPECT_NEAR(c.gaussian, gaussian, 1e-9 * (1.0 + std::abs(gaussian)));
      EXPECT_NEAR(c.mean, mean, 1e-9 * (1.0 + std::abs(mean)));
    }
  }
}
#endif

} // namespace
