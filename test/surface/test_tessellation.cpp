// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/tessellation.h>

#include "closed_surfaces.h"
#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;
using Corners = std::vector<Eigen::Vector2d>;

struct Topology {
  int euler = 0;
  int border_edges = 0;
  bool is_manifold = true; // no edge with more than two triangles, senses opposite
};

Topology
topologyOf(const TriangleMesh& mesh)
{
  std::map<std::pair<unsigned, unsigned>, int> directed;
  std::set<unsigned> used;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      ++directed[{t[i], t[(i + 1) % 3]}];
      used.insert(t[i]);
    }
  Topology result;
  int edges = 0;
  for (const auto& [edge, count] : directed) {
    result.is_manifold &= count == 1 && edge.first != edge.second;
    const bool has_twin = directed.count({edge.second, edge.first}) > 0;
    result.border_edges += has_twin ? 0 : 1;
    edges += has_twin && edge.first > edge.second ? 0 : 1;
  }
  EXPECT_EQ(used.size(), mesh.vertices.size()) << "unused vertices";
  result.euler =
      static_cast<int>(used.size()) - edges + static_cast<int>(mesh.triangles.size());
  return result;
}

double
areaOf(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (const auto& t : mesh.triangles)
    area += 0.5 * (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                      .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]])
                      .norm();
  return area;
}

/** Area in the (u, v) domain; a triangle the wrong way round counts negative. */
double
domainAreaOf(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector2d a = mesh.parameters[t[1]] - mesh.parameters[t[0]];
    const Eigen::Vector2d b = mesh.parameters[t[2]] - mesh.parameters[t[0]];
    const double twice = a.x() * b.y() - a.y() * b.x();
    EXPECT_GT(twice, -1e-12);
    area += 0.5 * twice;
  }
  return area;
}

/** Greatest distance between points of the surface at parameters inside of triangles
 * and the planes of these triangles. */
double
chordErrorOf(const TriangleMesh& mesh, const NurbsSurface& surface)
{
  double error = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d normal = (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                                       .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]])
                                       .normalized();
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j) {
        const Eigen::Vector2d uv =
            (i * mesh.parameters[t[0]] + j * mesh.parameters[t[1]] +
             (4 - i - j) * mesh.parameters[t[2]]) /
            4.0;
        error = std::max(error,
                         std::abs(normal.dot(surface.evaluate(uv.x(), uv.y()) -
                                             mesh.vertices[t[0]])));
      }
  }
  return error;
}

TrimLoop
circle(const Eigen::Vector2d& centre, double radius)
{
  const Eigen::Matrix3Xd profile = test::arcProfile(0.0, radius, 0, 4);
  NurbsCurve2::Points points = profile.topRows<2>();
  points.colwise() += centre;
  return TrimLoop({NurbsCurve2::fromControlPoints(
      test::quarterTurns(4), points, profile.row(2).transpose())});
}

TessellationOptions
withTolerance(double tolerance)
{
  TessellationOptions options;
  options.chord_tolerance = tolerance;
  return options;
}

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
  for (const double tolerance : {0.1, 1e-2, 1e-3, 1e-4}) {
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

/** Border of a random pixel mask: many collinear corners and touching steps. */
Corners
staircase(RandomNurbs& random, int columns, int rows)
{
  Corners corners;
  int low = rows / 4;
  int high = 3 * rows / 4;
  Corners top;
  for (int x = 0; x < columns; ++x) {
    corners.emplace_back(double(x) / columns, double(low) / rows);
    corners.emplace_back((x + 0.5) / columns, double(low) / rows);
    corners.emplace_back((x + 1.0) / columns, double(low) / rows);
    top.emplace_back(double(x) / columns, double(high) / rows);
    top.emplace_back((x + 1.0) / columns, double(high) / rows);
    low = std::clamp(low + random.integer(-2, 2), 0, rows / 2 - 1);
    high = std::clamp(high + random.integer(-2, 2), rows / 2 + 1, rows);
  }
  corners.insert(corners.end(), top.rbegin(), top.rend());
  return corners;
}

TEST(Tessellation, staircasesOfThousandsOfEdges)
{
  RandomNurbs random(7);
  for (const bool flat : {true, false}) {
    const NurbsSurface surface =
        flat ? NurbsSurface() : random.surface(3, 3, true, test::KnotKind::Bezier);
    const Eigen::Vector2d origin(surface.knotsU().domainMin(),
                                 surface.knotsV().domainMin());
    const Eigen::Vector2d size(surface.knotsU().domainLength(),
                               surface.knotsV().domainLength());
    Corners corners = staircase(random, 1000, 700);
    for (Eigen::Vector2d& corner : corners)
      corner = origin + corner.cwiseProduct(size);
    const TrimLoop loop = TrimLoop::polygon(corners);
    const TriangleMesh mesh =
        tessellate(TrimmedSurface(surface, {loop}), withTolerance(1e-3));
    const Topology topology = topologyOf(mesh);
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_EQ(topology.euler, 1);
    EXPECT_NEAR(domainAreaOf(mesh), loop.signedArea(), 1e-9);
    EXPECT_LE(chordErrorOf(mesh, surface), 1e-3);
  }
}

TEST(Tessellation, hostileLoops)
{
  const Corners square = {{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}};
  const auto areaWith = [&](std::vector<TrimLoop> loops) {
    const TriangleMesh mesh = tessellate(TrimmedSurface(NurbsSurface(), loops));
    EXPECT_TRUE(topologyOf(mesh).is_manifold);
    return domainAreaOf(mesh);
  };
  // Clockwise, twice the same, repeated corner, spike out and back.
  EXPECT_NEAR(areaWith({TrimLoop::polygon(square).reversed()}), 0.64, 1e-8);
  EXPECT_NEAR(
      areaWith({TrimLoop::polygon(square), TrimLoop::polygon(square)}), 0.64, 1e-8);
  EXPECT_NEAR(areaWith({TrimLoop::polygon(
                  {{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}})}),
              0.64,
              1e-8);
  EXPECT_NEAR(areaWith({TrimLoop::polygon({{0.1, 0.1},
                                           {0.5, 0.1},
                                           {0.5, 0.0},
                                           {0.5, 0.1},
                                           {0.9, 0.1},
                                           {0.9, 0.9},
                                           {0.1, 0.9}})}),
              0.64,
              1e-8);
  // A bow tie crosses itself in its middle; both halves wind.
  EXPECT_NEAR(
      areaWith({TrimLoop::polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}})}), 0.5, 1e-8);
  // A hole that touches the border, and one that is as large as the outside.
  EXPECT_NEAR(areaWith({TrimLoop::polygon(square),
                        TrimLoop::polygon({{0.1, 0.5}, {0.5, 0.7}, {0.5, 0.3}})}),
              0.64 - 0.08,
              1e-8);
  EXPECT_EQ(areaWith({TrimLoop::polygon(square), TrimLoop::polygon(square).reversed()}),
            0.0);
  // Beyond the domain only the domain counts.
  EXPECT_NEAR(
      areaWith({TrimLoop::polygon({{-1, -1}, {2, -1}, {2, 2}, {-1, 2}})}), 1.0, 1e-8);
}

TEST(Tessellation, manyRandomCrossingEdges)
{
  RandomNurbs random(31);
  for (int round = 0; round < 10; ++round) {
    Corners corners;
    for (int k = 0; k < 60; ++k)
      corners.emplace_back(random.uniform(0, 1), random.uniform(0, 1));
    const TrimmedSurface trimmed(NurbsSurface(), {TrimLoop::polygon(corners)});
    const TriangleMesh mesh = tessellate(trimmed);
    EXPECT_TRUE(topologyOf(mesh).is_manifold);
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector2d centre =
          (mesh.parameters[t[0]] + mesh.parameters[t[1]] + mesh.parameters[t[2]]) / 3.0;
      // Slivers next to rounded crossings may miss by a lattice step.
      if ((mesh.vertices[t[1]] - mesh.vertices[t[0]])
              .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]])
              .norm() > 1e-6) {
        EXPECT_TRUE(trimmed.contains(centre.x(), centre.y()));
      }
    }
    int inside = 0;
    for (int n = 0; n < 20000; ++n)
      inside += trimmed.contains(random.uniform(0, 1), random.uniform(0, 1)) ? 1 : 0;
    EXPECT_NEAR(domainAreaOf(mesh), inside / 20000.0, 0.02);
  }
}

/** Positions of border vertices, as bits. */
std::set<std::tuple<double, double, double>>
borderPositions(const TriangleMesh& mesh, std::uint32_t patch)
{
  std::map<std::pair<unsigned, unsigned>, int> directed;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      ++directed[{t[i], t[(i + 1) % 3]}];
  std::set<std::tuple<double, double, double>> positions;
  for (const auto& [edge, count] : directed)
    if (directed.count({edge.second, edge.first}) == 0)
      for (const unsigned v : {edge.first, edge.second})
        if (mesh.patch[v] == patch)
          positions.insert(
              {mesh.vertices[v].x(), mesh.vertices[v].y(), mesh.vertices[v].z()});
  return positions;
}

/** One mesh with vertices at equal positions joined: what is closed in space. */
TriangleMesh
joined(const TriangleMesh& mesh)
{
  TriangleMesh result;
  std::map<std::tuple<double, double, double>, unsigned> known;
  std::vector<unsigned> moved;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    const auto [at, is_new] = known.emplace(std::make_tuple(p.x(), p.y(), p.z()),
                                            static_cast<unsigned>(known.size()));
    if (is_new)
      result.vertices.push_back(p);
    moved.push_back(at->second);
  }
  for (const auto& t : mesh.triangles)
    result.triangles.push_back({moved[t[0]], moved[t[1]], moved[t[2]]});
  return result;
}

TEST(Tessellation, patchesThatShareATrimAreWatertight)
{
  // A sphere cut by one circle: the cap and the rest, the rest with another
  // parameterisation (the sphere turned by 90 degrees, so that its seam and poles are
  // elsewhere would change the curve; here u and v are exchanged).
  const NurbsSurface sphere = test::sphere(1.0);
  const TrimLoop cut = circle({1.5, 1.0}, 0.4);
  std::vector<NurbsCurve2> exchanged;
  for (const NurbsCurve2& curve : cut.curves()) {
    Eigen::Affine2d swap = Eigen::Affine2d::Identity();
    swap.linear() << 0, 1, 1, 0;
    exchanged.push_back(curve.transformed(swap));
  }
  const NurbsSurface other = sphere.transposed();
  SurfaceModel model;
  model.patches.resize(2);
  model.patches[0].geometry = TrimmedSurface(sphere, {cut});
  model.patches[1].geometry =
      TrimmedSurface(other, {TrimLoop::ofDomain(other), TrimLoop(exchanged)});
  for (const double tolerance : {1e-2, 1e-3}) {
    const TriangleMesh mesh = tessellate(model, withTolerance(tolerance));
    const auto cap = borderPositions(mesh, 0);
    EXPECT_GT(cap.size(), 8U);
    EXPECT_EQ(cap, borderPositions(mesh, 1));
    TriangleMesh closed = joined(mesh);
    // The exchanged patch faces inwards: turn it before the senses are compared.
    for (std::size_t i = 0; i < closed.triangles.size(); ++i)
      if (mesh.patch[mesh.triangles[i][0]] == 1)
        std::swap(closed.triangles[i][1], closed.triangles[i][2]);
    const Topology topology = topologyOf(closed);
    EXPECT_TRUE(topology.is_manifold);
    EXPECT_EQ(topology.border_edges, 0);
    EXPECT_EQ(topology.euler, 2);
  }
}

TEST(Tessellation, neighboursWithDifferentGridsAreWatertight)
{
  // A flat patch next to a wavy one: they share the straight side x = 0.
  RandomNurbs random(2);
  NurbsSurface wavy = random.surface(3, 3, false, test::KnotKind::Bezier);
  NurbsSurface::HomogeneousPoints points = wavy.homogeneousPoints();
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index j = 0; j < 4; ++j) {
      points(0, i * 4 + j) = static_cast<double>(i) / 3.0;
      points(1, i * 4 + j) = static_cast<double>(j) / 3.0;
      if (i == 0)
        points(2, j) = 0.0;
    }
  wavy = NurbsSurface(wavy.knotsU(), wavy.knotsV(), points);
  Eigen::Matrix3Xd corners(3, 4);
  corners << -1, -1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0; // v runs downwards here
  const NurbsSurface flat = NurbsSurface::fromControlPoints(
      KnotVector::bezier(1, 5.0, 9.0), KnotVector::bezier(1, -3.0, 1.0), corners);
  for (const bool wavy_first : {true, false}) {
    SurfaceModel model;
    model.patches.resize(2);
    model.patches[wavy_first ? 0 : 1].geometry = TrimmedSurface(wavy);
    model.patches[wavy_first ? 1 : 0].geometry = TrimmedSurface(flat);
    const TriangleMesh mesh = tessellate(model, withTolerance(1e-3));
    TriangleMesh both = joined(mesh);
    const Topology apart = topologyOf(mesh);
    EXPECT_EQ(apart.euler, 2);
    for (std::size_t i = 0; i < both.triangles.size(); ++i)
      if (mesh.patch[mesh.triangles[i][0]] == (wavy_first ? 1U : 0U))
        std::swap(both.triangles[i][1], both.triangles[i][2]);
    const Topology together = topologyOf(both);
    EXPECT_TRUE(together.is_manifold);
    EXPECT_EQ(together.euler, 1);
    EXPECT_GT(apart.border_edges, together.border_edges + 10);
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
