// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/tessellation.h>

#include "mesh_checks.h"
#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <tuple>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

TEST(Tessellation, planeIsTwoTriangles)
{
  const TriangleMesh mesh = tessellate(TrimmedSurface{NurbsSurface()});
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.normals.size(), 4U);
  EXPECT_EQ(mesh.patch.size(), 4U);
  EXPECT_EQ(mesh.parameters.size(), 4U);
  for (const Eigen::Vector3d& normal : mesh.normals)
    EXPECT_LT((normal - Eigen::Vector3d::UnitZ()).norm(), 1e-14);
}

TEST(Tessellation, closedSurfacesAreClosed)
{
  for (const double tolerance : {0.1, 1e-2, 1e-3}) {
    const TriangleMesh ball =
        tessellate(TrimmedSurface(test::sphere(1.0)), withTolerance(tolerance));
    const TriangleMesh ring =
        tessellate(TrimmedSurface(test::torus(2.0, 0.5)), withTolerance(tolerance));
    const TriangleMesh tube =
        tessellate(TrimmedSurface(test::cylinder(1.0, 3.0)), withTolerance(tolerance));
    EXPECT_TRUE(topologyOf(ball).is_manifold);
    EXPECT_TRUE(topologyOf(ring).is_manifold);
    EXPECT_TRUE(topologyOf(tube).is_manifold);
    EXPECT_EQ(topologyOf(ball).border_edges, 0);
    EXPECT_EQ(topologyOf(ring).border_edges, 0);
    EXPECT_EQ(topologyOf(ball).euler, 2);
    EXPECT_EQ(topologyOf(ring).euler, 0);
    EXPECT_EQ(topologyOf(tube).euler, 0);
    // A shell as thick as the tolerance bounds the volume, and so the area, from below.
    EXPECT_NEAR(areaOf(ball), 4.0 * M_PI, 4.0 * M_PI * 4.0 * tolerance);
    EXPECT_NEAR(areaOf(ring), 4.0 * M_PI * M_PI, 4.0 * M_PI * M_PI * 8.0 * tolerance);
    EXPECT_NEAR(areaOf(tube), 6.0 * M_PI, 6.0 * M_PI * 2.0 * tolerance);
    for (std::size_t i = 0; i < ball.vertices.size(); ++i) {
      EXPECT_NEAR(ball.vertices[i].norm(), 1.0, 1e-12);
      EXPECT_GT(ball.normals[i].dot(ball.vertices[i]), 1.0 - 1e-8);
    }
    double deepest = 0.0;
    for (const auto& t : ball.triangles)
      deepest = std::max(
          deepest,
          1.0 -
              (ball.vertices[t[0]] + ball.vertices[t[1]] + ball.vertices[t[2]]).norm() /
                  3.0);
    EXPECT_LE(deepest, tolerance);
    // The cylinder needs no cuts along its axis.
    EXPECT_EQ(tube.triangles.size(), tube.vertices.size());
  }
}

class TrimmedLaws : public testing::TestWithParam<std::tuple<int, bool, double>> {};

TEST_P(TrimmedLaws, meshIsInsideManifoldAndWithinTolerance)
{
  const auto [degree, rational, tolerance] = GetParam();
  RandomNurbs random(23);
  const NurbsSurface surface =
      random.surface(degree, degree, rational, test::KnotKind::ClampedRandom);
  const double u0 = surface.knotsU().domainMin();
  const double v0 = surface.knotsV().domainMin();
  const double lu = surface.knotsU().domainLength();
  const double lv = surface.knotsV().domainLength();
  const double r = 0.4 * std::min(lu, lv);
  const Eigen::Vector2d middle(u0 + 0.5 * lu, v0 + 0.5 * lv);
  const TrimmedSurface trimmed(
      surface,
      {circle(middle, r),
       circle(middle + Eigen::Vector2d(0.3 * r, 0), 0.3 * r).reversed(),
       circle(middle - Eigen::Vector2d(0.5 * r, 0.1 * r), 0.2 * r).reversed()});
  const TriangleMesh mesh = tessellate(trimmed, withTolerance(tolerance));
  const Topology topology = topologyOf(mesh);
  EXPECT_TRUE(topology.is_manifold);
  EXPECT_EQ(topology.euler, -1); // a disc with two holes
  EXPECT_LE(chordErrorOf(mesh, surface), tolerance);
  EXPECT_NEAR(domainAreaOf(mesh), M_PI * r * r * (1.0 - 0.09 - 0.04), 0.3 * r * r);
  EXPECT_NEAR(
      areaOf(mesh), trimmed.area(), 0.5 * trimmed.area() * std::sqrt(tolerance));
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         TrimmedLaws,
                         testing::Combine(testing::Values(1, 2, 3, 5),
                                          testing::Bool(),
                                          testing::Values(0.1, 1e-2, 1e-3)));

TEST(Tessellation, areaConvergesWithTheTolerance)
{
  const NurbsSurface sphere = test::sphere(1.0);
  const TrimmedSurface trimmed(sphere, {circle({2.0, 1.0}, 0.6)});
  const double exact = trimmed.area(1e-9);
  double last = HUGE_VAL;
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const double error =
        std::abs(areaOf(tessellate(trimmed, withTolerance(tolerance))) - exact);
    EXPECT_LT(error, 4.0 * tolerance);
    EXPECT_LT(error, last);
    last = error;
  }
}

TEST(Tessellation, levelsOfDetailAreNested)
{
  RandomNurbs random(9);
  SurfaceModel model;
  model.patches.resize(1);
  const NurbsSurface surface = random.surface(3, 3, true, test::KnotKind::Bezier);
  model.patches[0].geometry = TrimmedSurface(surface);
  const std::vector<TriangleMesh> levels =
      tessellateLevels(model, withTolerance(1e-4), 6);
  ASSERT_EQ(levels.size(), 6U);
  double tolerance = 1e-4;
  for (std::size_t k = 0; k < levels.size(); ++k, tolerance *= 2.0) {
    EXPECT_LE(chordErrorOf(levels[k], surface), tolerance);
    if (k > 0) {
      EXPECT_LT(levels[k].triangles.size(), levels[k - 1].triangles.size());
    }
  }
  EXPECT_THROW(tessellateLevels(model, {}, 0), std::invalid_argument);
}

TEST(Tessellation, longestEdgeIsKept)
{
  TessellationOptions options;
  options.max_edge_length = 0.05;
  const TriangleMesh mesh = tessellate(TrimmedSurface{NurbsSurface()}, options);
  EXPECT_EQ(mesh.triangles.size(), 800U);
}

TEST(Tessellation, rejectsBadOptions)
{
  const TrimmedSurface plane{NurbsSurface()};
  EXPECT_THROW(tessellate(plane, withTolerance(0.0)), std::invalid_argument);
  EXPECT_THROW(tessellate(plane, withTolerance(std::nan(""))), std::invalid_argument);
  TessellationOptions options;
  options.weld_tolerance = -1.0;
  EXPECT_THROW(tessellate(plane, options), std::invalid_argument);
  options = {};
  options.max_edge_length = -1.0;
  EXPECT_THROW(tessellate(plane, options), std::invalid_argument);
  EXPECT_THROW(tessellate(TrimmedSurface(test::sphere(1.0)), withTolerance(1e-14)),
               std::domain_error);
}

} // namespace
