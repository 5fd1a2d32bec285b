// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The nearest point against closed forms, against a search on grids that knows nothing
// of derivatives, and on the awkward places: poles, seams, creases, centres.

#include <pcl/surface/nurbs/closest_point.h>

#include "exact_shapes.h"
#include "grid_search.h"
#include "random_nurbs.h"
#ifdef PCL_NURBS_HAVE_SISL
#include "sisl_surface.h"
#endif

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <vector>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::GridSearch;
using pcl::nurbs::test::RandomNurbs;

void
expectConsistent(const NurbsSurface& surface,
                 const Eigen::Vector3d& query,
                 const ClosestPoint& found)
{
  EXPECT_TRUE(found.converged);
  EXPECT_LT((surface.evaluate(found.u, found.v) - found.point).norm(), 1e-11);
  EXPECT_NEAR(found.distance, (query - found.point).norm(), 1e-12);
  EXPECT_LE(std::abs(found.signed_distance), found.distance + 1e-12);
  EXPECT_EQ(surface.knotsU().clampToDomain(found.u), found.u);
  EXPECT_EQ(surface.knotsV().clampToDomain(found.v), found.v);
  if (!found.at_boundary) {
    const SurfaceJet1 jet = surface.evaluateJet1(found.u, found.v);
    const Eigen::Vector3d residual = query - found.point;
    EXPECT_LE(std::abs(residual.dot(jet.du)), 1e-8 * (1.0 + residual.norm()));
    EXPECT_LE(std::abs(residual.dot(jet.dv)), 1e-8 * (1.0 + residual.norm()));
  }
}

class ClosestPointLaws
    : public testing::TestWithParam<std::tuple<int, int, bool, int>> {};

TEST_P(ClosestPointLaws, isTheGlobalMinimum)
{
  RandomNurbs random(23);
  const auto [p, q, rational, kind] = GetParam();
  const NurbsSurface surface =
      random.surface(p, q, rational, static_cast<test::KnotKind>(kind));
  const ClosestPointFinder finder(surface);
  const GridSearch grid(surface, 60);
  const auto range = [&](double low, double high) {
    return random.uniform(low - 0.5, high + 0.5);
  };
  for (int n = 0; n < 40; ++n) {
    const Eigen::Vector3d query(
        range(surface.knotsU().domainMin(), surface.knotsU().domainMax()),
        range(surface.knotsV().domainMin(), surface.knotsV().domainMax()),
        random.uniform(-1.0, 1.0));
    const ClosestPoint found = finder.find(query);
    EXPECT_LE(found.distance, grid.distance(query) + 1e-9);
    // Creases hold minima whose gradients do not vanish.
    if (kind != static_cast<int>(test::KnotKind::ClampedRepeated) && p > 1 && q > 1)
      expectConsistent(surface, query, found);
  }
}

TEST_P(ClosestPointLaws, pointsOnTheSurfaceAreInverted)
{
  RandomNurbs random(29);
  const auto [p, q, rational, kind] = GetParam();
  const NurbsSurface surface =
      random.surface(p, q, rational, static_cast<test::KnotKind>(kind));
  const ClosestPointFinder finder(surface);
  for (int n = 0; n < 40; ++n) {
    const double u = random.inDomain(surface.knotsU());
    const double v = random.inDomain(surface.knotsV());
    const auto found = finder.invert(surface.evaluate(u, v), 1e-12);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x(), u, 1e-9);
    EXPECT_NEAR(found->y(), v, 1e-9);
  }
  EXPECT_FALSE(finder.invert({0.0, 0.0, 50.0}, 1e-3));
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         ClosestPointLaws,
                         testing::Combine(testing::Values(1, 2, 3, 5),
                                          testing::Values(1, 3),
                                          testing::Bool(),
                                          testing::Range(0, 4)));

TEST(ClosestPoint, sphereFromAnywhere)
{
  RandomNurbs random(31);
  const ClosestPointFinder finder(test::sphere(2.0));
  for (int n = 0; n < 500; ++n) {
    const double scale = std::pow(10.0, random.uniform(-3.0, 4.0));
    const Eigen::Vector3d query =
        scale * Eigen::Vector3d(random.normal(1), random.normal(1), random.normal(1));
    const ClosestPoint found = finder.find(query);
    EXPECT_NEAR(found.distance, std::abs(query.norm() - 2.0), 1e-9 * scale + 1e-12);
    EXPECT_NEAR(std::abs(found.signed_distance), found.distance, 1e-7 * scale);
    EXPECT_LT((found.point - 2.0 * query.normalized()).norm(), 1e-7 / scale + 1e-7);
  }
}

TEST(ClosestPoint, poleCentreAndAxis)
{
  const ClosestPointFinder sphere(test::sphere(2.0));
  EXPECT_NEAR(sphere.find({0, 0, 5}).distance, 3.0, 1e-13);
  EXPECT_NEAR(sphere.find({0, 0, -5}).distance, 3.0, 1e-13);
  EXPECT_NEAR(sphere.find({0, 0, 0}).distance, 2.0, 1e-9);
  EXPECT_NEAR(sphere.find({1e-7, 0, 0}).distance, 2.0 - 1e-7, 1e-9);
  const ClosestPointFinder cylinder(test::cylinder(1.0, 3.0));
  EXPECT_NEAR(cylinder.find({0, 0, 1.3}).distance, 1.0, 1e-9);
  EXPECT_NEAR(cylinder.find({0, 0, -4}).distance, std::sqrt(17.0), 1e-9);
  const ClosestPointFinder torus(test::torus(3.0, 1.0));
  EXPECT_NEAR(torus.find({0, 0, 0}).distance, 2.0, 1e-9);
  EXPECT_NEAR(torus.find({0, 0, 1}).distance, std::sqrt(10.0) - 1.0, 1e-9);
}

TEST(ClosestPoint, descentContinuesOverASeam)
{
  const ClosestPointFinder finder(test::torus(3.0, 1.0));
  // From just after the seam of both parameters to just before it.
  const double angle = -0.1;
  const Eigen::Vector3d query(4.2 * std::cos(angle), 4.2 * std::sin(angle), -0.1);
  const ClosestPoint found = finder.findFrom(query, 0.05, 0.05);
  const double tube = std::hypot(4.2 - 3.0, 0.1);
  EXPECT_TRUE(found.converged);
  EXPECT_FALSE(found.at_boundary);
  EXPECT_NEAR(found.distance, tube - 1.0, 1e-13);
  EXPECT_GT(found.u, 3.5);
  EXPECT_GT(found.v, 3.5);
}

TEST(ClosestPoint, bordersAndCorners)
{
  const ClosestPointFinder finder((NurbsSurface())); // the unit square
  const ClosestPoint corner = finder.find({2.0, 3.0, 1.0});
  EXPECT_NEAR(corner.distance, std::sqrt(6.0), 1e-14);
  EXPECT_TRUE(corner.at_boundary);
  EXPECT_NEAR(std::abs(corner.signed_distance), 1.0, 1e-14);
  const ClosestPoint edge = finder.findFrom({0.25, -1.0, 0.0}, 0.9, 0.9);
  EXPECT_TRUE(edge.converged);
  EXPECT_TRUE(edge.at_boundary);
  EXPECT_NEAR(edge.u, 0.25, 1e-14);
  EXPECT_EQ(edge.v, 0.0);
  const ClosestPoint above = finder.find({0.5, 0.25, 2.0});
  EXPECT_FALSE(above.at_boundary);
  EXPECT_NEAR(above.signed_distance, 2.0, 1e-14);
  EXPECT_NEAR(finder.find({0.5, 0.25, -2.0}).signed_distance, -2.0, 1e-14);
}

TEST(ClosestPoint, creaseHoldsTheMinimum)
{
  // A roof: two planes that meet in the ridge x = 0, z = 1.
  const KnotVector knots_u(1, {-1, -1, 0, 1, 1});
  Eigen::Matrix3Xd points(3, 6);
  points << -1, -1, 0, 0, 1, 1, //
      0, 1, 0, 1, 0, 1,         //
      0, 0, 1, 1, 0, 0;
  const ClosestPointFinder finder(
      NurbsSurface::fromControlPoints(knots_u, KnotVector::bezier(1), points));
  for (const double start : {-0.9, 0.9}) {
    const ClosestPoint found = finder.findFrom({0.1, 0.4, 2.0}, start, 0.9);
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.u, 0.0, 1e-12);
    EXPECT_NEAR(found.v, 0.4, 1e-12);
    EXPECT_NEAR(found.distance, std::hypot(0.1, 1.0), 1e-13);
  }
}

TEST(ClosestPoint, queriesFromManyThreadsAgree)
{
  RandomNurbs random(37);
  const ClosestPointFinder finder(test::heightField(3, 6, [](double x, double y) {
    return 0.25 * std::sin(3 * x) * std::cos(2 * y);
  }));
  std::vector<Eigen::Vector3d> queries;
  for (int n = 0; n < 200; ++n)
    queries.emplace_back(
        random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  const auto all = [&](std::vector<double>& distances) {
    for (const Eigen::Vector3d& query : queries)
      distances.push_back(finder.find(query).distance);
  };
  std::vector<std::vector<double>> results(4);
  std::vector<std::thread> threads;
  for (std::vector<double>& result : results)
    threads.emplace_back([&] { all(result); });
  for (std::thread& thread : threads)
    thread.join();
  for (const std::vector<double>& result : results)
    EXPECT_EQ(result, results.front());
}

TEST(ClosestPoint, rejectsWhatIsNotFinite)
{
  const ClosestPointFinder finder((NurbsSurface()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(finder.find({nan, 0, 0}), std::invalid_argument);
  EXPECT_THROW(finder.findFrom({0, 0, 0}, nan, 0), std::invalid_argument);
  EXPECT_THROW(finder.findFrom({0, 0, 0}, 0, 1.0 / 0.0), std::invalid_argument);
}

#ifdef PCL_NURBS_HAVE_SISL
TEST(ClosestPoint, agreesWithTheGlobalSearchOfSisl)
{
  // s1954 is global; s1958 only iterates and may end in another local minimum.
  RandomNurbs random(47);
  const NurbsSurface surface =
      random.surface(3, 2, true, test::KnotKind::ClampedRandom);
  const ClosestPointFinder finder(surface);
  const test::SislSurface sisl = test::toSisl(surface);
  for (int n = 0; n < 40; ++n) {
    Eigen::Vector3d query = surface.evaluate(random.inDomain(surface.knotsU()),
                                             random.inDomain(surface.knotsV()));
    for (int axis = 0; axis < 3; ++axis)
      query(axis) += random.normal(0.3);
    int points = 0;
    int curves = 0;
    int status = 0;
    double* uv = nullptr;
    SISLIntcurve** none = nullptr;
    s1954(
        sisl.get(), query.data(), 3, 0.0, 1e-9, &points, &uv, &curves, &none, &status);
    ASSERT_GE(status, 0);
    ASSERT_GE(points, 1);
    EXPECT_EQ(curves, 0);
    EXPECT_NEAR(finder.find(query).distance,
                (surface.evaluate(uv[0], uv[1]) - query).norm(),
                1e-8);
    std::free(uv);
  }
}
#endif

class CurveClosestPointLaws
    : public testing::TestWithParam<std::tuple<int, bool, int>> {};

TEST_P(CurveClosestPointLaws, isTheGlobalMinimum)
{
  RandomNurbs random(41);
  const auto [p, rational, kind] = GetParam();
  const auto curve = random.curve<2>(p, rational, static_cast<test::KnotKind>(kind));
  const CurveClosestPointFinder<2> finder(curve);
  const KnotVector& knots = curve.knots();
  for (int n = 0; n < 40; ++n) {
    const Eigen::Vector2d query(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
    const auto found = finder.find(query);
    EXPECT_LT((curve.evaluate(found.u) - found.point).norm(), 1e-12);
    constexpr int kSamples = 2000;
    for (int k = 0; k <= kSamples; ++k) {
      const double u = knots.domainMin() + knots.domainLength() * k / kSamples;
      EXPECT_LE(found.distance, (curve.evaluate(u) - query).norm() + 1e-12);
    }
    const double u = random.inDomain(knots);
    const auto inverted = finder.find(curve.evaluate(u));
    EXPECT_LT(inverted.distance, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         CurveClosestPointLaws,
                         testing::Combine(testing::Values(1, 2, 3, 5),
                                          testing::Bool(),
                                          testing::Range(0, 4)));

TEST(CurveClosestPoint, circleFromAnywhere)
{
  const NurbsCurve3 circle(test::circleKnots(), test::circlePoints());
  const CurveClosestPointFinder<3> finder(circle);
  RandomNurbs random(43);
  for (int n = 0; n < 300; ++n) {
    const Eigen::Vector3d query(
        random.normal(2.0), random.normal(2.0), random.normal(1.0));
    const auto found = finder.find(query);
    EXPECT_TRUE(found.converged);
    EXPECT_FALSE(found.at_boundary);
    EXPECT_NEAR(found.distance,
                std::hypot(query.head<2>().norm() - 1.0, query.z()),
                1e-12 * (1.0 + query.norm()));
  }
  EXPECT_THROW(finder.findFrom({0, 0, 0}, 1.0 / 0.0), std::invalid_argument);
}

} // namespace
