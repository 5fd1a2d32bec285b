// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Public reference files: closed forms they state, and an evaluation of every surface
// that shares no code with the library.

#include <pcl/surface/nurbs/surface_borders.h>

#include "iges_reader.h"
#include "independent_evaluation.h"
#include "quadrature.h"
#include "reference_readers.h"
#include "test_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

NurbsSurface
geomdlCylinder(const std::filesystem::path& path, std::vector<double> knots_v)
{
  return {KnotVector(), KnotVector(2, std::move(knots_v)), readGeomdlPoints(path)};
}

TEST(ReferenceFiles, geomdlCylindersHaveRadiusOne)
{
  PCL_NURBS_DATA_OR_SKIP(folder, "nurbs_reference/geomdl");
  const NurbsSurface cylinders[] = {
      geomdlCylinder(folder / "ex_cylinder.cptw",
                     {0, 0, 0, .25, .25, .5, .5, .75, .75, 1, 1, 1}),
      geomdlCylinder(folder / "ex_cylinder_half.cptw", {0, 0, 0, .5, .5, 1, 1, 1}),
      geomdlCylinder(folder / "ex_cylinder_quarter.cptw", {0, 0, 0, 1, 1, 1})};
  for (const NurbsSurface& surface : cylinders) {
    onGrid(surface, [&](double u, double v) {
      const Eigen::Vector3d p = surface.evaluate(u, v);
      // Weights are rounded to four digits: the circle is true to twice that, squared.
      EXPECT_NEAR(p.head<2>().norm(), 1.0, 1e-5);
      EXPECT_NEAR(p.z(), u, 1e-15);
    });
    expectIndependentEvaluationsAgree(surface);
  }
}

TEST(ReferenceFiles, geomdlSurfacesAgreeWithIndependentEvaluation)
{
  PCL_NURBS_DATA_OR_SKIP(folder, "nurbs_reference/geomdl");
  const KnotVector knots(3, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3});
  for (const char* name : {"ex_surface01.cpt", "ex_surface02.cpt"}) {
    const NurbsSurface surface =
        NurbsSurface::fromControlPoints(knots, knots, readGeomdlPoints(folder / name));
    EXPECT_FALSE(surface.isRational());
    EXPECT_EQ(surface.evaluate(0, 0), surface.controlPoint(0, 0));
    EXPECT_EQ(surface.evaluate(3, 3), surface.controlPoint(5, 5));
    expectIndependentEvaluationsAgree(surface);
  }
}

TEST(ReferenceFiles, geomdlCircleHasConstantRadius)
{
  PCL_NURBS_DATA_OR_SKIP(path, "nurbs_reference/geomdl/ex_curve04.cptw");
  const std::vector<double> numbers = readNumbers(readText(path), ",;");
  const NurbsCurve2 curve(KnotVector(2, {0, 0, 0, .25, .25, .5, .5, .75, .75, 1, 1, 1}),
                          Eigen::Map<const Eigen::Matrix3Xd>(numbers.data(), 3, 9));
  const double radius = curve.evaluate(0.0).norm();
  // The file gives weights and points to three digits.
  for (int i = 0; i <= 100; ++i)
    EXPECT_NEAR(curve.evaluate(0.01 * i).norm(), radius, 5e-5 * radius);
}

TEST(ReferenceFiles, gismoCylinderIsExact)
{
  PCL_NURBS_DATA_OR_SKIP(path, "nurbs_reference/gismo/cylinder.xml");
  const NurbsSurface surface = readGismo(path).at(0);
  EXPECT_TRUE(surface.isRational());
  // The axis is the middle of two opposite joints of the exact circle.
  const Eigen::Vector3d axis =
      0.5 * (surface.controlPoint(0, 0) + surface.controlPoint(4, 0));
  EXPECT_LT((axis.head<2>() - Eigen::Vector2d(5.0977, -26.1245)).norm(), 1e-4);
  const double radius = (surface.controlPoint(0, 0) - axis).norm();
  EXPECT_NEAR(radius, 7.39115, 1e-5);
  onGrid(surface, [&](double u, double v) {
    const SurfaceJet1 jet = surface.evaluateJet1(u, v);
    const Eigen::Vector2d spoke = (jet.position - axis).head<2>();
    EXPECT_NEAR(spoke.norm(), radius, 1e-13 * radius);
    EXPECT_LE(std::abs(jet.du.head<2>().dot(spoke)), 1e-12 * radius * radius);
    EXPECT_GE(jet.position.z(), -1e-13);
    EXPECT_LE(jet.position.z(), 23.7456);
  });
  expectIndependentEvaluationsAgree(surface);
}

TEST(ReferenceFiles, scordelisLoRoofIsExact)
{
  PCL_NURBS_DATA_OR_SKIP(path, "nurbs_reference/gismo/scordelis_lo_roof.xml");
  const std::vector<NurbsSurface> surfaces = readGismo(path);
  ASSERT_EQ(surfaces.size(), 1u);
  const NurbsSurface& roof = surfaces[0];
  // Radius 25 over 80 degrees, borders at height 0.
  const double forty_degrees = 0.69813170079773183;
  const Eigen::Vector2d axis(-25.0 * std::sin(forty_degrees),
                             -25.0 * std::cos(forty_degrees));
  onGrid(roof, [&](double u, double v) {
    const Eigen::Vector3d p = roof.evaluate(u, v);
    EXPECT_NEAR((p.tail<2>() - axis).norm(), 25.0, 1e-12);
    EXPECT_NEAR(p.x(), 50.0 * u, 1e-13);
  });
  EXPECT_NEAR(quadratureArea(roof, 20), 50.0 * 25.0 * 2.0 * forty_degrees, 1e-9);
  expectIndependentEvaluationsAgree(roof);
}

/** How many borders of the patches, poles left out, have a twin: another border that is
 * the same curve, in either sense. */
int
bordersWithTwin(const std::vector<NurbsSurface>& patches, double tolerance)
{
  std::vector<NurbsCurve3> borders;
  for (const NurbsSurface& patch : patches)
    for (const SurfaceBorder border : kSurfaceBorders)
      if (!isDegenerate(patch, border, tolerance))
        borders.push_back(borderCurve(patch, border));
  const auto same = [&](const NurbsCurve3& a, const NurbsCurve3& b) {
    for (int i = 0; i <= 10; ++i)
      if ((a.evaluate(0.1 * i) - b.evaluate(0.1 * i)).norm() > tolerance)
        return false;
    return true;
  };
  int found = 0;
  for (const NurbsCurve3& a : borders)
    for (const NurbsCurve3& b : borders)
      if (&a != &b && (same(a, b) || same(a, b.reversed()))) {
        ++found;
        break;
      }
  return found;
}

TEST(ReferenceFiles, teapotPatchesJoin)
{
  PCL_NURBS_DATA_OR_SKIP(folder, "nurbs_reference");
  const std::vector<NurbsSurface> gismo = readGismo(folder / "gismo/teapot.xml");
  const std::vector<NurbsSurface> geomview =
      readBezierPatches(folder / "geomview/teapot.bez");
  ASSERT_EQ(gismo.size(), 32u);
  ASSERT_EQ(geomview.size(), 28u); // without the bottom
  // Of the borders that are no pole (4 at the lid, 4 at the bottom), those that stay
  // free are 4 each at the inner rim and the lid, 2 at either end of spout and handle;
  // without the bottom also 4 below.
  EXPECT_EQ(bordersWithTwin(gismo, 1e-5), 32 * 4 - 8 - 16);
  EXPECT_EQ(bordersWithTwin(geomview, 1e-5), 28 * 4 - 4 - 20);
  for (const std::vector<NurbsSurface>& teapot : {gismo, geomview})
    for (const NurbsSurface& patch : teapot)
      expectIndependentEvaluationsAgree(patch);
}

TEST(ReferenceFiles, igesSurfacesAgreeWithIndependentEvaluation)
{
  PCL_NURBS_DATA_OR_SKIP(folder, "nurbs_reference/iges");
  const std::tuple<const char*, std::size_t, int> files[] = {
      {"hammer.iges", 45, 27}, {"sunglasses_lens.igs", 9, 0}};
  for (const auto& [name, count, rational] : files) {
    const IgesReader file(folder / name);
    ASSERT_EQ(file.ofType(128).size(), count);
    int found = 0;
    for (const int number : file.ofType(128)) {
      const NurbsSurface surface = file.surface(number);
      found += surface.isRational() ? 1 : 0;
      expectIndependentEvaluationsAgree(surface);
    }
    EXPECT_EQ(found, rational);
  }
}

/** Largest gap between the end of a curve of a closed chain and the next start. */
double
largestGap(const std::vector<NurbsCurve3>& chain)
{
  double gap = 0.0;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const NurbsCurve3& next = chain[(i + 1) % chain.size()];
    gap = std::max(gap,
                   (chain[i].evaluate(chain[i].knots().domainMax()) -
                    next.evaluate(next.knots().domainMin()))
                       .norm());
  }
  return gap;
}

/** Points at equal steps of the parameter, both ends included. */
std::vector<Eigen::Vector3d>
samples(const NurbsCurve3& curve, int steps)
{
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k <= steps; ++k)
    points.push_back(curve.evaluate(curve.knots().domainMin() +
                                    curve.knots().domainLength() * k / steps));
  return points;
}

double
distanceToPolyline(const Eigen::Vector3d& p, const std::vector<Eigen::Vector3d>& line)
{
  double least = (p - line[0]).norm();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Eigen::Vector3d d = line[i + 1] - line[i];
    const double t = d.dot(p - line[i]) / std::max(d.squaredNorm(), 1e-300);
    least = std::min(least, (p - line[i] - std::clamp(t, 0.0, 1.0) * d).norm());
  }
  return least;
}

TEST(ReferenceFiles, igesTrimmingCurvesLieOnTheirSurfaces)
{
  PCL_NURBS_DATA_OR_SKIP(path, "nurbs_reference/iges/hammer.iges");
  const IgesReader file(path);
  const double resolution = 1e-3; // millimetres, stated by the file
  ASSERT_EQ(file.ofType(142).size(), 48u);
  for (const int number : file.ofType(142)) {
    const std::vector<double> p = file.parameters(number);
    const NurbsSurface surface = file.surface(static_cast<int>(p.at(1)));
    const std::vector<NurbsCurve3> in_domain = file.chain(static_cast<int>(p.at(2)));
    const std::vector<NurbsCurve3> in_space = file.chain(static_cast<int>(p.at(3)));
    EXPECT_LT(largestGap(in_domain), 1e-6);
    EXPECT_LT(largestGap(in_space), resolution);
    ASSERT_EQ(in_domain.size(), in_space.size());
    for (std::size_t i = 0; i < in_space.size(); ++i) {
      // Curves of up to 10 m that were interpolated separately: they meet at the ends,
      // and in between leave each other by up to 2e-4 of their length (2.3 mm; another
      // evaluation of the file finds the same).
      std::vector<Eigen::Vector3d> lifted = samples(in_domain[i], 40);
      for (Eigen::Vector3d& point : lifted)
        point = surface.evaluate(point.x(), point.y());
      const std::vector<Eigen::Vector3d> line = samples(in_space[i], 1000);
      EXPECT_LT((lifted.front() - line.front()).norm(), resolution);
      EXPECT_LT((lifted.back() - line.back()).norm(), resolution);
      double length = 0.0;
      for (std::size_t k = 0; k + 1 < line.size(); ++k)
        length += (line[k + 1] - line[k]).norm();
      for (const Eigen::Vector3d& point : lifted)
        EXPECT_LT(distanceToPolyline(point, line), 3e-4 * length + resolution);
    }
  }
}

} // namespace
