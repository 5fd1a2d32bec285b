// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Exact analytic shapes against their closed forms.

#include <pcl/surface/nurbs/primitives.h>

#include "quadrature.h"
#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;

constexpr double kPi = 3.14159265358979323846;

/** What is known of a shape without NURBS, as functions of a point in its frame. */
struct AnalyticShape {
  using Scalar = std::function<double(const Eigen::Vector3d&)>;
  NurbsSurface surface;
  Scalar distance;
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> normal;
  Scalar curvature_1; // principal curvatures, negative where it bends away from normal
  Scalar curvature_2;
  double area;
};

double
rho(const Eigen::Vector3d& p)
{
  return p.head<2>().norm();
}

class PrimitiveLaws : public testing::TestWithParam<std::tuple<std::string, double>> {
protected:
  RandomNurbs random{29};
  double size = std::get<1>(GetParam());
  Eigen::Isometry3d frame = randomFrame();
  AnalyticShape shape = make(std::get<0>(GetParam()));

  Eigen::Isometry3d
  randomFrame()
  {
    const auto vector = [this] {
      return Eigen::Vector3d(
          random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    };
    return Eigen::Translation3d(size * vector()) *
           Eigen::AngleAxisd(random.uniform(0.0, 3.0), vector().normalized());
  }

  AngleRange
  partialTurn()
  {
    const double first = random.uniform(-4.0, 4.0);
    return {first, first + random.uniform(0.01, 2.0 * kPi)};
  }

  AnalyticShape
  make(const std::string& name)
  {
    const bool partial = name.find("partial") != std::string::npos;
    const AngleRange turn = partial ? partialTurn() : AngleRange{};
    if (name == "plane")
      return makePlane();
    if (name.find("cylinder") != std::string::npos)
      return makeFrustum(size, size, 0.7 * size, turn);
    if (name.find("cone") != std::string::npos)
      return makeFrustum(partial ? 0.0 : size, partial ? size : 0.0, 1.3 * size, turn);
    if (name.find("frustum") != std::string::npos)
      return makeFrustum(0.8 * size, 1.9 * size, 0.4 * size, turn);
    if (name.find("sphere") != std::string::npos)
      return makeSphere(turn, partial ? AngleRange{-0.3, 1.1} : kAllLatitudes);
    return makeTorus(turn, partial ? partialTurn() : AngleRange{});
  }

  AnalyticShape
  makePlane() const
  {
    const auto zero = [](const Eigen::Vector3d&) { return 0.0; };
    return {planePatch(frame, size, 2.0 * size),
            [](const Eigen::Vector3d& p) { return p.z(); },
            [](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 1); },
            zero,
            zero,
            2.0 * size * size};
  }

  /** Also the cylinder and the cone. */
  AnalyticShape
  makeFrustum(double bottom, double top, double height, const AngleRange& turn) const
  {
    const double slope = (top - bottom) / height;
    const double cosine = 1.0 / std::sqrt(1.0 + slope * slope);
    AnalyticShape result;
    result.surface = bottom == top ? cylinder(frame, bottom, height, turn)
                     : top == 0.0  ? cone(frame, bottom, height, turn)
                                   : frustum(frame, bottom, top, height, turn);
    result.distance = [=](const Eigen::Vector3d& p) {
      return (rho(p) - bottom - slope * p.z()) * cosine;
    };
    result.normal = [=](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      return cosine * Eigen::Vector3d(p.x() / rho(p), p.y() / rho(p), -slope);
    };
    result.curvature_1 = [](const Eigen::Vector3d&) { return 0.0; };
    result.curvature_2 = [=](const Eigen::Vector3d& p) { return -cosine / rho(p); };
    result.area = 0.5 * turn.sweep() * (bottom + top) * height / cosine;
    return result;
  }

  AnalyticShape
  makeSphere(const AngleRange& longitude, const AngleRange& latitude) const
  {
    const double radius = size;
    const auto curvature = [=](const Eigen::Vector3d&) { return -1.0 / radius; };
    return {sphere(frame, radius, longitude, latitude),
            [=](const Eigen::Vector3d& p) { return p.norm() - radius; },
            [](const Eigen::Vector3d& p) { return p.normalized(); },
            curvature,
            curvature,
            radius * radius * longitude.sweep() *
                (std::sin(latitude.last) - std::sin(latitude.first))};
  }

  AnalyticShape
  makeTorus(const AngleRange& around, const AngleRange& tube) const
  {
    const double major = size;
    const double minor = 0.3 * size;
    const auto from_centre_line = [=](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      return p - major * Eigen::Vector3d(p.x(), p.y(), 0.0) / rho(p);
    };
    AnalyticShape result;
    result.surface = torus(frame, major, minor, around, tube);
    result.distance = [=](const Eigen::Vector3d& p) {
      return from_centre_line(p).norm() - minor;
    };
    result.normal = [=](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      return from_centre_line(p).normalized();
    };
    result.curvature_1 = [=](const Eigen::Vector3d&) { return -1.0 / minor; };
    result.curvature_2 = [=](const Eigen::Vector3d& p) {
      return -(rho(p) - major) / (minor * rho(p));
    };
    result.area =
        minor * around.sweep() *
        (major * tube.sweep() + minor * (std::sin(tube.last) - std::sin(tube.first)));
    return result;
  }

  /** Random parameter; \a margin keeps that share of the domain away from poles. */
  Eigen::Vector2d
  parameter(double margin)
  {
    const KnotVector& v = shape.surface.knotsV();
    return {random.inDomain(shape.surface.knotsU()),
            v.domainMin() + v.domainLength() * random.uniform(margin, 1.0 - margin)};
  }

  Eigen::Vector3d
  local(const Eigen::Vector3d& point) const
  {
    return frame.inverse() * point;
  }
};

TEST_P(PrimitiveLaws, everyPointLiesOnTheShape)
{
  for (int n = 0; n < 300; ++n) {
    const Eigen::Vector2d uv = parameter(0.0);
    const Eigen::Vector3d p = local(shape.surface.evaluate(uv.x(), uv.y()));
    EXPECT_LT(std::abs(shape.distance(p)), 1e-14 * size);
  }
}

TEST_P(PrimitiveLaws, normalsAreThoseOfTheShape)
{
  for (int n = 0; n < 100; ++n) {
    const Eigen::Vector2d uv = parameter(0.01);
    const Eigen::Vector3d p = local(shape.surface.evaluate(uv.x(), uv.y()));
    const Eigen::Vector3d normal =
        frame.linear().transpose() * shape.surface.normal(uv.x(), uv.y());
    EXPECT_LT((normal - shape.normal(p)).norm(), 1e-12);
  }
}

TEST_P(PrimitiveLaws, curvaturesAreThoseOfTheShape)
{
  for (int n = 0; n < 100; ++n) {
    const Eigen::Vector2d uv = parameter(0.05);
    const SurfaceJet2 jet = shape.surface.evaluateJet2(uv.x(), uv.y());
    const Eigen::Vector3d normal = jet.du.cross(jet.dv).normalized();
    Eigen::Matrix2d first;
    Eigen::Matrix2d second;
    first << jet.du.dot(jet.du), jet.du.dot(jet.dv), jet.du.dot(jet.dv),
        jet.dv.dot(jet.dv);
    second << jet.duu.dot(normal), jet.duv.dot(normal), jet.duv.dot(normal),
        jet.dvv.dot(normal);
    const Eigen::Matrix2d weingarten = first.inverse() * second;
    const Eigen::Vector3d p = local(jet.position);
    const double k1 = shape.curvature_1(p);
    const double k2 = shape.curvature_2(p);
    const double scale = 1.0 / size + std::abs(k1) + std::abs(k2);
    EXPECT_NEAR(weingarten.trace(), k1 + k2, 1e-11 * scale);
    EXPECT_NEAR(weingarten.determinant(), k1 * k2, 1e-11 * scale * scale);
  }
}

TEST_P(PrimitiveLaws, areaIsThatOfTheShape)
{
  EXPECT_NEAR(test::quadratureArea(shape.surface, 24), shape.area, 1e-12 * shape.area);
}

INSTANTIATE_TEST_SUITE_P(Shapes,
                         PrimitiveLaws,
                         testing::Combine(testing::Values("plane",
                                                          "cylinder",
                                                          "partial cylinder",
                                                          "cone",
                                                          "partial cone",
                                                          "frustum",
                                                          "partial frustum",
                                                          "sphere",
                                                          "partial sphere",
                                                          "torus",
                                                          "partial torus"),
                                          testing::Values(1e-6, 1e-3, 1.0, 1e3, 1e6)));

TEST(Primitives, parametersAreAnglesAndLengths)
{
  const Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const NurbsSurface patch = planePatch(frame, 3.0, 4.0);
  EXPECT_LT((patch.evaluate(1.25, 3.5) - Eigen::Vector3d(1.25, 3.5, 0.0)).norm(),
            1e-15);
  const NurbsSurface tube = cylinder(frame, 2.0, 5.0, {0.5, 2.0});
  EXPECT_EQ(tube.knotsU().domainMin(), 0.5);
  EXPECT_EQ(tube.knotsU().domainMax(), 2.0);
  EXPECT_NEAR(tube.evaluate(1.0, 3.25).z(), 3.25, 1e-15);
  const NurbsSurface ball = sphere(frame, 2.0);
  EXPECT_LT((ball.evaluate(0.25 * kPi, 0.25 * kPi) -
             Eigen::Vector3d(1.0, 1.0, std::sqrt(2.0)))
                .norm(),
            1e-14);
  const NurbsSurface ring = torus(frame, 2.0, 1.0);
  EXPECT_LT((ring.evaluate(0.5 * kPi, kPi) - Eigen::Vector3d(0, 1, 0)).norm(), 1e-14);
  EXPECT_LT((ring.evaluate(0.0, 0.5 * kPi) - Eigen::Vector3d(2, 0, 1)).norm(), 1e-14);
}

TEST(Primitives, badInputThrows)
{
  const Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  Eigen::Isometry3d stretched = frame;
  stretched.linear() *= 1.001;
  Eigen::Isometry3d mirrored = frame;
  mirrored.linear()(2, 2) = -1.0;
  for (const Eigen::Isometry3d& bad : {stretched, mirrored}) {
    EXPECT_THROW(planePatch(bad, 1, 1), std::invalid_argument);
    EXPECT_THROW(cylinder(bad, 1, 1), std::invalid_argument);
    EXPECT_THROW(sphere(bad, 1), std::invalid_argument);
  }
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    EXPECT_THROW(planePatch(frame, bad, 1), std::invalid_argument);
    EXPECT_THROW(planePatch(frame, 1, bad), std::invalid_argument);
    EXPECT_THROW(cylinder(frame, bad, 1), std::invalid_argument);
    EXPECT_THROW(cylinder(frame, 1, bad), std::invalid_argument);
    EXPECT_THROW(cone(frame, bad, 1), std::invalid_argument);
    EXPECT_THROW(sphere(frame, bad), std::invalid_argument);
    EXPECT_THROW(torus(frame, bad, 1), std::invalid_argument);
    EXPECT_THROW(torus(frame, 1, bad), std::invalid_argument);
    EXPECT_THROW(cylinder(frame, 1, 1, {0.0, bad}), std::invalid_argument);
  }
  EXPECT_THROW(frustum(frame, 0, 0, 1), std::invalid_argument);
  EXPECT_THROW(frustum(frame, -1, 2, 1), std::invalid_argument);
  EXPECT_THROW(cylinder(frame, 1, 1, {0.0, 6.3}), std::invalid_argument);
  EXPECT_THROW(sphere(frame, 1, {}, {-1.6, 0.0}), std::invalid_argument);
  EXPECT_THROW(sphere(frame, 1, {}, {0.0, 1.6}), std::invalid_argument);
  EXPECT_THROW(torus(frame, 1, 2), std::invalid_argument);
  EXPECT_THROW(torus(frame, 1, 2, {}, {2.0, 4.0}), std::invalid_argument);
  EXPECT_NO_THROW(torus(frame, 1, 2, {}, {-1.0, 1.0}));
}

} // namespace
