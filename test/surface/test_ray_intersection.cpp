// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/ray_intersection.h>

#include "exact_shapes.h"
#include "random_nurbs.h"
#ifdef PCL_NURBS_HAVE_SISL
#include "sisl_surface.h"
#endif

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;

Eigen::Vector3d
gaussian(RandomNurbs& random)
{
  return {random.normal(1.0), random.normal(1.0), random.normal(1.0)};
}

void
expectOnBoth(const NurbsSurface& surface, const Ray& ray, const RayHit& hit)
{
  EXPECT_LT((surface.evaluate(hit.u, hit.v) - hit.point).norm(), 1e-11);
  EXPECT_LT((ray.origin + hit.t * ray.direction - hit.point).norm(), 1e-10);
}

TEST(RayIntersection, sphereAgreesWithTheQuadratic)
{
  RandomNurbs random(91);
  const NurbsSurface sphere = test::sphere(2.0);
  const RayIntersector rays(sphere);
  for (int n = 0; n < 2000; ++n) {
    const Ray ray{2.0 * gaussian(random), gaussian(random)};
    const double a = ray.direction.squaredNorm();
    const double b = ray.origin.dot(ray.direction);
    const double discriminant = b * b - a * (ray.origin.squaredNorm() - 4.0);
    std::vector<double> expected;
    for (const double sign : {-1.0, 1.0})
      if (discriminant > 0.0 && -b + sign * std::sqrt(discriminant) >= 0.0)
        expected.push_back((-b + sign * std::sqrt(discriminant)) / a);
    const std::vector<RayHit> hits = rays.intersect(ray);
    ASSERT_EQ(hits.size(), expected.size());
    for (std::size_t i = 0; i < hits.size(); ++i) {
      EXPECT_NEAR(hits[i].t, expected[i], 1e-10 * (1.0 + expected[i]));
      expectOnBoth(sphere, ray, hits[i]);
    }
    const auto nearest = rays.nearest(ray);
    ASSERT_EQ(nearest.has_value(), !expected.empty());
    if (nearest) {
      EXPECT_NEAR(nearest->t, expected.front(), 1e-10 * (1.0 + expected.front()));
    }
  }
}

TEST(RayIntersection, polesSeamsAndContactsAreReportedOnce)
{
  const RayIntersector sphere(test::sphere(2.0));
  const auto through = [](const RayIntersector& rays,
                          const Eigen::Vector3d& from,
                          const Eigen::Vector3d& along) {
    return rays.intersect({from, along});
  };
  EXPECT_EQ(through(sphere, {0, 0, -5}, {0, 0, 1}).size(), 2u); // poles
  EXPECT_EQ(through(sphere, {5, 0, 0}, {-1, 0, 0}).size(), 2u); // seam
  for (const Eigen::Vector3d& from :
       {Eigen::Vector3d(-5, 2, 0), Eigen::Vector3d(-5, 1.2, 1.6)}) {
    const auto touching = through(sphere, from, {1, 0, 0});
    ASSERT_EQ(touching.size(), 1u);
    EXPECT_TRUE(touching[0].tangential);
    EXPECT_NEAR(touching[0].t, 5.0, 1e-5);
  }
  EXPECT_EQ(through(sphere, {-5, 2 + 1e-8, 0}, {1, 0, 0}).size(), 0u);
  const auto secant = through(sphere, {-5, 2 - 1e-8, 0}, {1, 0, 0});
  ASSERT_EQ(secant.size(), 2u);
  EXPECT_NEAR(secant[1].t - secant[0].t, 2 * std::sqrt(4e-8), 1e-7);

  const RayIntersector torus(test::torus(3.0, 1.0));
  EXPECT_EQ(through(torus, {-9, 0, 0}, {1, 0, 0}).size(), 4u);
  const auto inner = through(torus, {-9, 2, 0}, {1, 0, 0}); // touches the inner circle
  ASSERT_EQ(inner.size(), 3u);
  EXPECT_NEAR(inner[0].t, 9 - std::sqrt(12.0), 1e-9);
  EXPECT_TRUE(inner[1].tangential);
}

TEST(RayIntersection, aRulingIsADenseSequenceOfContacts)
{
  const RayIntersector rays(test::cylinder(1.0, 3.0));
  const auto hits = rays.intersect({{0.6, 0.8, -1.0}, {0, 0, 1}});
  ASSERT_GT(hits.size(), 50u);
  EXPECT_NEAR(hits.front().t, 1.0, 0.1);
  EXPECT_NEAR(hits.back().t, 4.0, 0.1);
  for (const RayHit& hit : hits)
    EXPECT_TRUE(hit.tangential);
}

TEST(RayIntersection, rangesAndUnits)
{
  const RayIntersector rays(test::sphere(2.0));
  EXPECT_EQ(rays.intersect(Ray::segment({0, 0.1, 0.2}, {1, 0.1, 0.2})).size(), 0u);
  EXPECT_EQ(rays.intersect(Ray::segment({0, 0.1, 0.2}, {3, 0.1, 0.2})).size(), 1u);
  EXPECT_EQ(rays.intersect(Ray::segment({-3, 0.1, 0.2}, {3, 0.1, 0.2})).size(), 2u);
  const auto scaled = rays.nearest({{-1e6, 0.1, 0.2}, {1e5, 0, 0}});
  ASSERT_TRUE(scaled);
  EXPECT_NEAR(scaled->t, 10.0 - 1e-5 * std::sqrt(4.0 - 0.05), 1e-12);
  EXPECT_EQ(rays.intersect({{3, 0, 0}, {1, 0, 0}}).size(), 0u);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(rays.intersect({{3, 0.1, 0}, {1, 0, 0}, -infinity, infinity}).size(), 2u);
}

TEST(RayIntersection, rejectsBadRays)
{
  const RayIntersector rays((NurbsSurface()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(rays.intersect({{0, 0, 0}, {0, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(rays.intersect({{nan, 0, 0}, {0, 0, 1}}), std::invalid_argument);
  EXPECT_THROW(rays.nearest({{0, 0, 0}, {0, 0, 1}, 1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(rays.nearest({{0, 0, 0}, {0, 0, 1}, nan, 1.0}), std::invalid_argument);
}

class RayLaws : public testing::TestWithParam<std::tuple<int, int, bool, int>> {};

TEST_P(RayLaws, findsThePointsTheRayWasDrawnThrough)
{
  RandomNurbs random(97);
  const auto [p, q, rational, kind] = GetParam();
  const NurbsSurface surface =
      random.surface(p, q, rational, static_cast<test::KnotKind>(kind));
  const RayIntersector rays(surface);
  for (int n = 0; n < 60; ++n) {
    const Eigen::Vector3d through = surface.evaluate(random.inDomain(surface.knotsU()),
                                                     random.inDomain(surface.knotsV()));
    const Eigen::Vector3d direction = gaussian(random);
    const Ray ray{through - 2.5 * direction, direction};
    const std::vector<RayHit> hits = rays.intersect(ray);
    bool found = false;
    for (const RayHit& hit : hits) {
      expectOnBoth(surface, ray, hit);
      found = found || std::abs(hit.t - 2.5) * direction.norm() < 1e-7;
    }
    EXPECT_TRUE(found);
    ASSERT_FALSE(hits.empty());
    EXPECT_NEAR(rays.nearest(ray)->t, hits.front().t, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         RayLaws,
                         testing::Combine(testing::Values(1, 2, 3, 5),
                                          testing::Values(1, 3),
                                          testing::Bool(),
                                          testing::Range(0, 4)));

TEST(RayIntersection, countsSignChangesOfAHeightField)
{
  // x = u and y = v, so along a ray z - S_z is a function of t whose sign changes can
  // be counted by brute force.
  RandomNurbs random(101);
  const NurbsSurface surface = test::heightField(
      3, 6, [&](double, double) { return random.uniform(-0.5, 0.5); });
  const RayIntersector rays(surface);
  for (int n = 0; n < 200; ++n) {
    const Ray ray =
        Ray::segment({random.uniform(-0.99, 0.99), random.uniform(-0.99, 0.99), 0.3},
                     {random.uniform(-0.99, 0.99), random.uniform(-0.99, 0.99), -0.3});
    std::size_t changes = 0;
    double previous = 0.0;
    constexpr int kSteps = 4000;
    for (int k = 0; k <= kSteps; ++k) {
      const Eigen::Vector3d point = ray.origin + ray.direction * k / kSteps;
      const double above = point.z() - surface.evaluate(point.x(), point.y()).z();
      changes += k > 0 && (above > 0.0) != (previous > 0.0) ? 1 : 0;
      previous = above;
    }
    EXPECT_EQ(rays.intersect(ray).size(), changes);
  }
}

#ifdef PCL_NURBS_HAVE_SISL
TEST(RayIntersection, agreesWithSisl)
{
  RandomNurbs random(103);
  const NurbsSurface surface =
      random.surface(3, 3, true, test::KnotKind::ClampedRandom);
  const RayIntersector rays(surface);
  const test::SislSurface sisl = test::toSisl(surface);
  const double infinity = std::numeric_limits<double>::infinity();
  for (int n = 0; n < 30; ++n) {
    Ray line{surface.evaluate(random.inDomain(surface.knotsU()),
                              random.inDomain(surface.knotsV())),
             gaussian(random),
             -infinity,
             infinity};
    int points = 0;
    int curves = 0;
    int status = 0;
    double* parameters = nullptr;
    SISLIntcurve** intersection_curves = nullptr;
    s1856(sisl.get(),
          line.origin.data(),
          line.direction.data(),
          3,
          0.0,
          1e-9,
          &points,
          &parameters,
          &curves,
          &intersection_curves,
          &status);
    ASSERT_GE(status, 0);
    EXPECT_EQ(curves, 0);
    const std::vector<RayHit> hits = rays.intersect(line);
    EXPECT_EQ(hits.size(), static_cast<std::size_t>(points));
    for (int k = 0; k < points; ++k) {
      double nearest = infinity;
      for (const RayHit& hit : hits)
        nearest = std::min(
            nearest,
            std::hypot(hit.u - parameters[2 * k], hit.v - parameters[2 * k + 1]));
      EXPECT_LT(nearest, 1e-6);
    }
    std::free(parameters);
  }
}
#endif

} // namespace
