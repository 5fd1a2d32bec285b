// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Laws of surfaces made from curves: they hold the curves they were made from.

#include <pcl/surface/nurbs/constructions.h>

#include "curve_checks.h"
#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** The same control points with weights nearer to 1: very uneven ones can make a sum or
 * an interpolation of weights negative, which is refused. */
template <class Points>
Points
softened(const Points& homogeneous)
{
  const Eigen::RowVectorXd old = homogeneous.row(3);
  const Eigen::RowVectorXd weights = (0.1 * old.array() + 0.9).matrix();
  return homogeneous * (weights.array() / old.array()).matrix().asDiagonal();
}

class ConstructionLaws : public testing::TestWithParam<std::tuple<int, bool, int>> {
protected:
  RandomNurbs random{53};

  /** A curve of the parameter's kind; \a shift moves it as a whole. */
  NurbsCurve3
  curve(int more_degree = 0, const Eigen::Vector3d& shift = Eigen::Vector3d::Zero())
  {
    const auto& [degree, rational, kind] = GetParam();
    return random
        .curve<3>(
            std::min(degree + more_degree, 9), rational, static_cast<KnotKind>(kind))
        .transformed(Eigen::Affine3d(Eigen::Translation3d(shift)));
  }
};

TEST_P(ConstructionLaws, ruledSurfaceHoldsBothCurvesAndStraightLines)
{
  const NurbsCurve3 start = curve();
  const NurbsCurve3 end = curve(1);
  const NurbsSurface surface = ruledSurface(start, end);
  expectSameCurve(surface.isoCurve(Direction::V, 0.0), start);
  expectSameCurve(surface.isoCurve(Direction::V, 1.0), end);
  for (int n = 0; n < 50; ++n) {
    const double u = random.inDomain(surface.knotsU());
    const Eigen::Vector3d a = surface.evaluate(u, 0.0);
    const Eigen::Vector3d b = surface.evaluate(u, 1.0);
    const Eigen::Vector3d p = surface.evaluate(u, random.uniform(0.0, 1.0));
    EXPECT_LT((p - a).cross(b - a).norm(), 1e-12);
    EXPECT_NEAR((p - a).norm() + (p - b).norm(), (a - b).norm(), 1e-12);
  }
}

TEST_P(ConstructionLaws, revolvedSurfaceTurnsTheGeneratrix)
{
  const NurbsCurve3 generatrix = curve();
  const Eigen::Isometry3d axis = frameFromAxis({0.2, -0.1, 0.4}, {1.0, 2.0, -0.5});
  const AngleRange sweep{-0.4, 2.9};
  const NurbsSurface surface = revolvedSurface(generatrix, axis, sweep);
  for (int n = 0; n < 100; ++n) {
    const double u = random.inDomain(surface.knotsU());
    const double v = random.inDomain(surface.knotsV());
    const Eigen::Vector3d p = axis.inverse() * surface.evaluate(u, v);
    const Eigen::Vector3d q = axis.inverse() * generatrix.evaluate(v);
    EXPECT_NEAR(p.head<2>().norm(), q.head<2>().norm(), 1e-13);
    EXPECT_NEAR(p.z(), q.z(), 1e-13);
  }
  for (const double angle : surface.knotsU().breaks()) {
    const Eigen::Isometry3d turn =
        axis * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) * axis.inverse();
    expectSameCurve(surface.isoCurve(Direction::U, angle),
                    generatrix.transformed(turn));
  }
}

TEST_P(ConstructionLaws, translationalSurfaceIsASum)
{
  const NurbsCurve3 profile = curve();
  const NurbsCurve3 trajectory = curve(1);
  const NurbsSurface surface = translationalSurface(profile, trajectory);
  const Eigen::Vector3d start = trajectory.evaluate(trajectory.knots().domainMin());
  for (int n = 0; n < 100; ++n) {
    const double u = random.inDomain(profile.knots());
    const double v = random.inDomain(trajectory.knots());
    EXPECT_LT(
        (surface.evaluate(u, v) - profile.evaluate(u) - trajectory.evaluate(v) + start)
            .norm(),
        1e-13);
  }
}

TEST_P(ConstructionLaws, extrusionMovesTheProfileByALength)
{
  const NurbsCurve3 profile = curve();
  const Eigen::Vector3d direction(1.0, -2.0, 2.0);
  const NurbsSurface surface = extrudedSurface(profile, direction);
  EXPECT_EQ(surface.knotsV().domainMax(), 3.0);
  for (int n = 0; n < 50; ++n) {
    const double u = random.inDomain(profile.knots());
    const double v = random.uniform(0.0, 3.0);
    EXPECT_LT(
        (surface.evaluate(u, v) - profile.evaluate(u) - v / 3.0 * direction).norm(),
        1e-13);
  }
}

TEST_P(ConstructionLaws, loftHoldsEverySection)
{
  std::vector<NurbsCurve3> sections;
  for (int k = 0; k < 6; ++k) {
    const NurbsCurve3 section = curve(k % 2, {0.0, 0.0, 4.0 * k});
    sections.emplace_back(section.knots(),
                          (k + 1.0) * softened(section.homogeneousPoints()));
  }
  const bool rational = std::get<1>(GetParam());
  for (const int degree : {1, 2, 3, 5}) {
    if (rational &&
        degree == 5) // one polynomial through 6 weights need not be positive
      continue;
    const std::vector<double> parameters{0.0, 0.5, 1.5, 2.0, 3.0, 4.0};
    const NurbsSurface given = loftedSurface(sections, degree, parameters);
    EXPECT_EQ(given.knotsV().degree(), degree);
    for (std::size_t k = 0; k < sections.size(); ++k)
      expectSameCurve(given.isoCurve(Direction::V, parameters[k]), sections[k]);
    const NurbsSurface chosen = loftedSurface(sections, degree);
    EXPECT_EQ(chosen.knotsV().domainMin(), 0.0);
    EXPECT_EQ(chosen.knotsV().domainMax(), 1.0);
    expectSameCurve(chosen.isoCurve(Direction::V, 0.0), sections.front());
    expectSameCurve(chosen.isoCurve(Direction::V, 1.0), sections.back());
  }
}

/** Borders of a random surface, of whose corners the weights are made equal only by
 * belonging to one surface. */
TEST_P(ConstructionLaws, coonsPatchHoldsItsBorders)
{
  const auto& [degree, rational, kind] = GetParam();
  const NurbsSurface raw =
      random.surface(degree, 3, rational, static_cast<KnotKind>(kind));
  const NurbsSurface source(
      raw.knotsU(), raw.knotsV(), softened(raw.homogeneousPoints()));
  const KnotVector& u = source.knotsU();
  const KnotVector& v = source.knotsV();
  const NurbsCurve3 bottom = source.isoCurve(Direction::V, v.domainMin());
  const NurbsCurve3 top = source.isoCurve(Direction::V, v.domainMax());
  const NurbsCurve3 left = source.isoCurve(Direction::U, u.domainMin());
  const NurbsCurve3 right = source.isoCurve(Direction::U, u.domainMax());
  const NurbsCurve3 scaled(right.knots(), 3.0 * right.homogeneousPoints());
  const NurbsSurface patch = coonsSurface(bottom, top, left, scaled);
  expectSameCurve(patch.isoCurve(Direction::V, 0.0), bottom);
  expectSameCurve(patch.isoCurve(Direction::V, 1.0), top);
  expectSameCurve(patch.isoCurve(Direction::U, 0.0), left);
  expectSameCurve(patch.isoCurve(Direction::U, 1.0), right);
}

INSTANTIATE_TEST_SUITE_P(Curves,
                         ConstructionLaws,
                         testing::Combine(testing::Values(1, 2, 3, 5),
                                          testing::Bool(),
                                          testing::Range(0, 4)));

} // namespace
