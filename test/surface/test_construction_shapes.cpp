// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Surfaces made from known curves are known shapes; bad input is refused.

#include <pcl/surface/nurbs/constructions.h>

#include "curve_checks.h"
#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

constexpr double kPi = 3.14159265358979323846;

TEST(Constructions, bilinearBlendIsTheTextbookFormula)
{
  RandomNurbs random(7);
  const NurbsSurface s = random.surface(3, 4, false, KnotKind::ClampedRandom);
  const KnotVector& ku = s.knotsU();
  const KnotVector& kv = s.knotsV();
  const NurbsSurface patch = coonsSurface(s.isoCurve(Direction::V, kv.domainMin()),
                                          s.isoCurve(Direction::V, kv.domainMax()),
                                          s.isoCurve(Direction::U, ku.domainMin()),
                                          s.isoCurve(Direction::U, ku.domainMax()));
  const auto on = [&](double u, double v) { return s.evaluate(at(ku, u), at(kv, v)); };
  for (int n = 0; n < 100; ++n) {
    const double u = random.uniform(0.0, 1.0);
    const double v = random.uniform(0.0, 1.0);
    const Eigen::Vector3d ruled =
        (1 - v) * on(u, 0) + v * on(u, 1) + (1 - u) * on(0, v) + u * on(1, v);
    const Eigen::Vector3d corners = (1 - u) * ((1 - v) * on(0, 0) + v * on(0, 1)) +
                                    u * ((1 - v) * on(1, 0) + v * on(1, 1));
    EXPECT_LT((patch.evaluate(u, v) - ruled + corners).norm(), 1e-13);
  }
}

TEST(Constructions, sweptCircleMakesCylinderAndTorus)
{
  const Eigen::Isometry3d frame = frameFromAxis({1, 2, 3}, {0.3, -0.4, 1.0});
  const NurbsCurve3 path = circularArc(frame, 5.0, {0.0, 2.0});
  // The tube's circle stands across the start of the path.
  Eigen::Isometry3d across = frame * Eigen::Translation3d(5.0, 0.0, 0.0) *
                             Eigen::AngleAxisd(0.5 * kPi, Eigen::Vector3d::UnitX());
  const NurbsCurve3 circle = circularArc(across, 1.0);
  const auto error = [&](int sections) {
    const NurbsSurface tube = sweptSurface(circle, path, sections);
    double worst = 0.0;
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; j <= 200; ++j) {
        const Eigen::Vector3d p =
            frame.inverse() *
            tube.evaluate(at(tube.knotsU(), i / 40.0), at(tube.knotsV(), j / 200.0));
        const double d = std::hypot(p.head<2>().norm() - 5.0, p.z()) - 1.0;
        worst = std::max(worst, std::abs(d));
      }
    return worst;
  };
  EXPECT_LT(error(17), 2e-4);
  EXPECT_LT(error(33), error(17) / 8.0);

  NurbsCurve3::Points ends(3, 2);
  ends << across.translation(), across.translation() + 7.0 * across.linear().col(2);
  const NurbsSurface cylinder = sweptSurface(
      circle, NurbsCurve3::fromControlPoints(KnotVector::bezier(1), ends), 4);
  for (int i = 0; i <= 20; ++i) {
    const Eigen::Vector3d p =
        across.inverse() * cylinder.evaluate(at(cylinder.knotsU(), 0.05 * i), 0.37);
    EXPECT_NEAR(p.head<2>().norm(), 1.0, 1e-13);
    EXPECT_NEAR(p.z(), 0.37 * 7.0, 1e-13);
  }
}

TEST(Constructions, sweepCarriesTheProfileRigidly)
{
  RandomNurbs random(11);
  const NurbsCurve3 path = random.curve<3>(3, true, KnotKind::ClampedRandom);
  const NurbsCurve3 profile = random.curve<3>(3, true, KnotKind::ClampedRandom);
  const int sections = 9;
  const int spans = static_cast<int>(path.knots().breaks().size()) - 1;
  const NurbsSurface surface = sweptSurface(profile, path, spans * 8 + 1);
  expectSameCurve(surface.isoCurve(Direction::V, surface.knotsV().domainMin()),
                  profile);
  const double first = path.knots().breaks()[0];
  const double step = (path.knots().breaks()[1] - first) / 8;
  for (int k = 0; k < sections; ++k) {
    const NurbsCurve3 copy = surface.isoCurve(Direction::V, first + k * step);
    const Eigen::Vector3d centre = path.evaluate(first + k * step);
    const Eigen::Vector3d tangent = path.derivatives(first + k * step, 1)[1];
    const Eigen::Vector3d tangent_0 = path.derivatives(first, 1)[1];
    for (int n = 0; n < 20; ++n) {
      const double u = random.inDomain(profile.knots());
      const Eigen::Vector3d arm = copy.evaluate(u) - centre;
      const Eigen::Vector3d arm_0 = profile.evaluate(u) - path.evaluate(first);
      EXPECT_NEAR(arm.norm(), arm_0.norm(), 1e-12);
      EXPECT_NEAR(
          arm.dot(tangent.normalized()), arm_0.dot(tangent_0.normalized()), 1e-12);
    }
  }
}

TEST(Constructions, badInputThrows)
{
  RandomNurbs random(1);
  const NurbsCurve3 a = random.curve<3>(3, false, KnotKind::Bezier);
  const NurbsCurve3 b = random.curve<3>(2, true, KnotKind::ClampedRandom);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(loftedSurface({}, 1), std::invalid_argument);
  EXPECT_THROW(loftedSurface({a, b}, 2), std::invalid_argument);
  EXPECT_THROW(loftedSurface({a, b}, 0), std::invalid_argument);
  EXPECT_THROW(loftedSurface({a, a}, 1), std::invalid_argument);
  EXPECT_THROW(loftedSurface({a, b, b}, 1), std::invalid_argument);
  EXPECT_THROW(loftedSurface({a, b}, 1, {0.0}), std::invalid_argument);
  EXPECT_THROW(loftedSurface({a, b}, 1, {1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(loftedSurface({a, b}, 1, {0.0, nan}), std::invalid_argument);
  EXPECT_THROW(coonsSurface(a, b, a, b), std::invalid_argument);
  EXPECT_THROW(extrudedSurface(a, Eigen::Vector3d::Zero()), std::invalid_argument);
  EXPECT_THROW(extrudedSurface(a, {0, nan, 1}), std::invalid_argument);
  EXPECT_THROW(sweptSurface(a, b, 1), std::invalid_argument);
  Eigen::Isometry3d stretched = Eigen::Isometry3d::Identity();
  stretched.linear() *= 2.0;
  EXPECT_THROW(revolvedSurface(a, stretched), std::invalid_argument);
  EXPECT_THROW(revolvedSurface(a, Eigen::Isometry3d::Identity(), {0.0, 7.0}),
               std::invalid_argument);
  const NurbsCurve3 point = NurbsCurve3::fromControlPoints(
      KnotVector::bezier(2), Eigen::Matrix3Xd::Ones(3, 3));
  EXPECT_THROW(sweptSurface(a, point, 3), std::domain_error);
}

TEST(Constructions, coonsRefusesWeightsThatCannotAgree)
{
  const NurbsSurface square;
  const auto border = [&](Direction fixed, double at, double last_weight) {
    NurbsCurve3::HomogeneousPoints points =
        square.isoCurve(fixed, at).homogeneousPoints();
    points.col(1) *= last_weight;
    return NurbsCurve3(KnotVector(), points);
  };
  EXPECT_THROW(coonsSurface(border(Direction::V, 0.0, 2.0),
                            border(Direction::V, 1.0, 1.0),
                            border(Direction::U, 0.0, 1.0),
                            border(Direction::U, 1.0, 1.0)),
               std::invalid_argument);
}

} // namespace
