// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/trimmed_surface.h>

#include "closed_surfaces.h"
#include "random_nurbs.h"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;
using Corners = std::vector<Eigen::Vector2d>;

/** Star-shaped polygon with random radii; counter-clockwise. */
Corners
star(RandomNurbs& random, const Eigen::Vector2d& centre, double low, double high, int n)
{
  Corners corners;
  for (int k = 0; k < n; ++k) {
    const double angle = 2.0 * M_PI * k / n;
    corners.push_back(centre + random.uniform(low, high) *
                                   Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

/** Sum of the angles under which the edges are seen: an independent winding number. */
int
windingByAngles(const std::vector<Corners>& polygons, const Eigen::Vector2d& p)
{
  double angle = 0.0;
  for (const Corners& corners : polygons)
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d a = corners[i] - p;
      const Eigen::Vector2d b = corners[(i + 1) % corners.size()] - p;
      angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    }
  return static_cast<int>(std::lround(angle / (2.0 * M_PI)));
}

NurbsCurve2
circle(const Eigen::Vector2d& centre, double radius)
{
  const Eigen::Matrix3Xd profile = test::arcProfile(0.0, radius, 0, 4);
  NurbsCurve2::Points points = profile.topRows<2>();
  points.colwise() += centre;
  return NurbsCurve2::fromControlPoints(
      test::quarterTurns(4), points, profile.row(2).transpose());
}

TEST(TrimLoop, rejectsOpenChains)
{
  EXPECT_THROW(TrimLoop({}), std::invalid_argument);
  EXPECT_THROW(TrimLoop({NurbsCurve2()}), std::invalid_argument);
  EXPECT_THROW(TrimLoop::polygon({{0, 0}, {1, 0}}), std::invalid_argument);
  const auto segment = [](double x0, double y0, double x1, double y1) {
    return NurbsCurve2::fromControlPoints(
        KnotVector::bezier(1), (Eigen::Matrix2d() << x0, x1, y0, y1).finished());
  };
  EXPECT_THROW(
      TrimLoop({segment(0, 0, 1, 0), segment(1, 0, 1, 1), segment(1, 1, 0, 1e-6)}),
      std::invalid_argument);
  EXPECT_NO_THROW(TrimLoop(
      {segment(0, 0, 1, 0), segment(1, 0, 1, 1), segment(1, 1, 0, 1e-6)}, 1e-5));
}

TEST(TrimLoop, polygonIsExact)
{
  RandomNurbs random(3);
  const Corners corners = star(random, {0.5, 0.5}, 0.1, 0.4, 37);
  const TrimLoop loop = TrimLoop::polygon(corners);
  const Corners flat = loop.flattened(0.1);
  ASSERT_EQ(flat.size(), corners.size());
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    EXPECT_LT((flat[i] - corners[i]).norm(), 1e-15);
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    area += 0.5 * (corners[i].x() * b.y() - corners[i].y() * b.x());
  }
  EXPECT_NEAR(loop.signedArea(), area, 1e-14);
  EXPECT_NEAR(loop.reversed().signedArea(), -area, 1e-14);
  EXPECT_THROW(loop.flattened(0.0), std::invalid_argument);
}

TEST(TrimLoop, circleFlattensToTheTolerance)
{
  const TrimLoop loop({circle({2.0, -1.0}, 0.7)});
  EXPECT_NEAR(loop.signedArea(), M_PI * 0.49, 1e-12);
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    const Corners corners = loop.flattened(tolerance);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d middle =
          0.5 * (corners[i] + corners[(i + 1) % corners.size()]);
      EXPECT_LE(0.7 - (middle - Eigen::Vector2d(2.0, -1.0)).norm(), 1.01 * tolerance);
    }
    // Not finer than needed either: twice the corners of the ideal polygon, times two
    // for halving.
    EXPECT_LE(corners.size(), 4.0 * M_PI / std::sqrt(2.0 * tolerance / 0.7) + 8.0);
  }
}

TEST(TrimmedSurface, containsAgreesWithAngleSums)
{
  RandomNurbs random(11);
  for (int round = 0; round < 20; ++round) {
    std::vector<Corners> polygons = {
        star(random, {0.5, 0.5}, 0.25, 0.5, random.integer(3, 60))};
    for (int hole = 0; hole < 3; ++hole) {
      Corners corners = star(random,
                             {random.uniform(0.3, 0.7), random.uniform(0.3, 0.7)},
                             0.02,
                             0.1,
                             random.integer(3, 20));
      std::reverse(corners.begin(), corners.end());
      polygons.push_back(corners);
    }
    std::vector<TrimLoop> loops;
    for (const Corners& corners : polygons)
      loops.push_back(TrimLoop::polygon(corners));
    const TrimmedSurface surface(NurbsSurface(), loops);
    for (int n = 0; n < 2000; ++n) {
      const Eigen::Vector2d p(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0));
      ASSERT_EQ(surface.contains(p.x(), p.y()), windingByAngles(polygons, p) != 0) << p;
    }
  }
}

TEST(TrimmedSurface, containsAgreesWithBoostOnPixelMasks)
{
  namespace bg = boost::geometry;
  using Point = bg::model::d2::point_xy<double>;
  RandomNurbs random(5);
  // Staircase: a random walk of heights above, zero below.
  Corners corners;
  const int columns = 300;
  int height = 50;
  corners.emplace_back(columns, 0);
  for (int x = columns; x > 0; --x) {
    corners.emplace_back(x, height);
    corners.emplace_back(x - 1, height);
    height = std::clamp(height + random.integer(-5, 5), 1, 99);
  }
  corners.emplace_back(0, 0);
  bg::model::polygon<Point, false> polygon;
  for (const Eigen::Vector2d& c : corners)
    bg::append(polygon.outer(), Point(c.x(), c.y()));
  bg::append(polygon.outer(), Point(corners.front().x(), corners.front().y()));
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 0, 300, 300, 0, 100, 0, 100, 0, 0, 0, 0;
  const TrimmedSurface surface(
      NurbsSurface::fromControlPoints(
          KnotVector::bezier(1, 0, 300), KnotVector::bezier(1, 0, 100), points),
      {TrimLoop::polygon(corners)});
  for (int n = 0; n < 20000; ++n) {
    // Half steps hit corners and edges as often as the inside.
    const Point p(0.5 * random.integer(0, 600), 0.5 * random.integer(0, 200));
    ASSERT_EQ(surface.contains(p.x(), p.y()), bg::covered_by(p, polygon))
        << p.x() << ' ' << p.y();
  }
}

TEST(TrimmedSurface, combOfLongEdgesStaysExact)
{
  Corners corners = {{0.0, 0.0}, {1.0, 0.0}};
  const int teeth = 1000;
  for (int k = teeth; k > 0; --k) {
    corners.emplace_back((k + 0.0) / teeth, 1.0);
    corners.emplace_back((k - 0.5) / teeth, 0.01);
  }
  const TrimmedSurface surface(NurbsSurface(), {TrimLoop::polygon(corners)});
  for (int k = 1; k < teeth; ++k) {
    EXPECT_TRUE(surface.contains((k + 0.0) / teeth, 0.9));
    EXPECT_FALSE(surface.contains((k + 0.5) / teeth, 0.9));
    EXPECT_TRUE(surface.contains((k + 0.5) / teeth, 0.005));
  }
}

TEST(TrimmedSurface, bordersAndOutsideOfTheDomain)
{
  const TrimmedSurface whole{NurbsSurface()};
  EXPECT_TRUE(whole.contains(0.0, 1.0));
  EXPECT_FALSE(whole.contains(-1e-9, 0.5));
  EXPECT_FALSE(whole.contains(0.5, 1.0 + 1e-9));
  EXPECT_FALSE(whole.contains(std::numeric_limits<double>::quiet_NaN(), 0.5));
  const TrimmedSurface same(NurbsSurface(), {TrimLoop::ofDomain(NurbsSurface())});
  for (const double t : {0.0, 0.3, 1.0}) {
    EXPECT_TRUE(same.contains(t, 0.0));
    EXPECT_TRUE(same.contains(t, 1.0));
    EXPECT_TRUE(same.contains(0.0, t));
    EXPECT_TRUE(same.contains(1.0, t));
  }
  const TrimmedSurface disc(NurbsSurface(), {TrimLoop({circle({0.5, 0.5}, 0.25)})});
  for (int k = 0; k < 360; ++k) {
    const Eigen::Vector2d d(std::cos(k * M_PI / 180), std::sin(k * M_PI / 180));
    EXPECT_TRUE(disc.contains(0.5 + 0.24999 * d.x(), 0.5 + 0.24999 * d.y()));
    EXPECT_FALSE(disc.contains(0.5 + 0.25001 * d.x(), 0.5 + 0.25001 * d.y()));
  }
}

TEST(TrimmedSurface, areasOfClosedForms)
{
  EXPECT_NEAR(TrimmedSurface(test::sphere(2.0)).area(1e-9), 16.0 * M_PI, 1e-7);
  EXPECT_NEAR(
      TrimmedSurface(test::torus(3.0, 0.5)).area(1e-9), 6.0 * M_PI * M_PI, 1e-6);
  EXPECT_NEAR(TrimmedSurface(test::cylinder(0.5, 2.0)).area(1e-9), 2.0 * M_PI, 1e-8);
}

TEST(TrimmedSurface, areasOfTrimmedForms)
{
  // The disc of the unit square, with a smaller one cut out.
  const TrimmedSurface ring(NurbsSurface(),
                            {TrimLoop({circle({0.5, 0.5}, 0.4)}),
                             TrimLoop({circle({0.6, 0.5}, 0.1)}).reversed()});
  EXPECT_NEAR(ring.area(1e-10), M_PI * 0.15, 1e-9);
  // Between two parallels a sphere has the area of the cylinder around it.
  const NurbsSurface sphere = test::sphere(1.0);
  const double low = sphere.evaluate(0.0, 0.6).z();
  const double high = sphere.evaluate(0.0, 1.7).z();
  const TrimmedSurface zone(
      sphere, {TrimLoop::polygon({{0, 0.6}, {4, 0.6}, {4, 1.7}, {0, 1.7}})});
  EXPECT_NEAR(zone.area(1e-8), 2.0 * M_PI * (high - low), 1e-6);
  EXPECT_THROW(zone.area(0.0), std::invalid_argument);
}

} // namespace
