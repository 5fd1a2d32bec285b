// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/bounding_box.h>

#include "exact_shapes.h"
#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <tuple>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;

class BoundingBoxLaws : public testing::TestWithParam<std::tuple<int, bool, int>> {};

TEST_P(BoundingBoxLaws, tightBoxHoldsTheSurfaceAndIsReached)
{
  RandomNurbs random(71);
  const auto [degree, rational, kind] = GetParam();
  const NurbsSurface surface =
      random.surface(degree, 3, rational, static_cast<test::KnotKind>(kind))
          .transformed(random.affine());
  const Eigen::AlignedBox3d control = controlBox(surface);
  const Eigen::AlignedBox3d tight = tightBox(surface);
  const double diagonal = control.diagonal().norm();
  Eigen::AlignedBox3d sampled;
  constexpr int kCells = 150;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j)
      sampled.extend(surface.evaluate(
          surface.knotsU().domainMin() + surface.knotsU().domainLength() * i / kCells,
          surface.knotsV().domainMin() + surface.knotsV().domainLength() * j / kCells));
  EXPECT_TRUE((tight.max() - sampled.max()).minCoeff() > -1e-12 * diagonal);
  EXPECT_TRUE((sampled.min() - tight.min()).minCoeff() > -1e-12 * diagonal);
  // Samples miss an extremum by the square of their spacing.
  EXPECT_LT((tight.max() - sampled.max()).maxCoeff(), 5e-3 * diagonal);
  EXPECT_LT((sampled.min() - tight.min()).maxCoeff(), 5e-3 * diagonal);
  EXPECT_TRUE((control.max() - tight.max()).minCoeff() > -1e-8 * diagonal);
}

TEST_P(BoundingBoxLaws, curvesToo)
{
  RandomNurbs random(73);
  const auto [degree, rational, kind] = GetParam();
  const auto curve =
      random.curve<2>(degree, rational, static_cast<test::KnotKind>(kind));
  const Eigen::AlignedBox2d tight = tightBox(curve, 1e-12);
  Eigen::AlignedBox2d sampled;
  for (int i = 0; i <= 5000; ++i)
    sampled.extend(curve.evaluate(curve.knots().domainMin() +
                                  curve.knots().domainLength() * i / 5000));
  for (const double knot : curve.knots().breaks()) // corners
    sampled.extend(curve.evaluate(knot));
  EXPECT_TRUE((tight.max() - sampled.max()).minCoeff() > -1e-12);
  EXPECT_TRUE((sampled.min() - tight.min()).minCoeff() > -1e-12);
  EXPECT_LT((tight.max() - sampled.max()).maxCoeff(), 1e-4);
  EXPECT_LT((sampled.min() - tight.min()).maxCoeff(), 1e-4);
  EXPECT_TRUE(controlBox(curve).contains(sampled));
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         BoundingBoxLaws,
                         testing::Combine(testing::Values(1, 2, 3, 5),
                                          testing::Bool(),
                                          testing::Range(0, 4)));

TEST(BoundingBox, turnedSphereAndTorus)
{
  const Eigen::Affine3d turn(
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  const Eigen::AlignedBox3d sphere =
      tightBox(test::sphere(2.0).transformed(turn), 1e-12);
  EXPECT_LT((sphere.max().array() - 2.0).abs().maxCoeff(), 1e-10);
  EXPECT_LT((sphere.min().array() + 2.0).abs().maxCoeff(), 1e-10);
  const Eigen::AlignedBox3d torus = tightBox(test::torus(3.0, 1.0), 1e-12);
  EXPECT_LT((torus.max() - Eigen::Vector3d(4, 4, 1)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(BoundingBox, rejectsToleranceThatCannotBeMet)
{
  EXPECT_THROW(tightBox(NurbsSurface(), 0.0), std::invalid_argument);
  EXPECT_THROW(tightBox(NurbsCurve2(), -1.0), std::invalid_argument);
}

} // namespace
