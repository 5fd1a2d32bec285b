// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Laws every surface must obey, over degrees, knot vectors and weights.

#include <pcl/surface/nurbs/nurbs_surface.h>

#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;

class SurfaceLaws : public testing::TestWithParam<std::tuple<int, int, bool, int>> {
protected:
  RandomNurbs random{17};
  NurbsSurface surface =
      random.surface(std::get<0>(GetParam()),
                     std::get<1>(GetParam()),
                     std::get<2>(GetParam()),
                     static_cast<test::KnotKind>(std::get<3>(GetParam())));

  Eigen::Vector2d
  parameter()
  {
    return {random.inDomain(surface.knotsU()), random.inDomain(surface.knotsV())};
  }
};

TEST_P(SurfaceLaws, basisIsPartitionOfUnity)
{
  for (int n = 0; n < 50; ++n) {
    const double u = parameter().x();
    BasisDerivatives basis;
    surface.knotsU().evaluateBasisDerivatives(
        surface.knotsU().findSpan(u), u, 3, basis);
    for (int k = 0; k <= 3; ++k) {
      double sum = 0.0;
      double scale = 1.0;
      for (int r = 0; r <= surface.knotsU().degree(); ++r) {
        sum += basis[k][r];
        scale = std::max(scale, std::abs(basis[k][r]));
        if (k == 0) {
          EXPECT_GE(basis[0][r], 0.0);
        }
      }
      EXPECT_NEAR(sum, k == 0 ? 1.0 : 0.0, 1e-12 * scale);
    }
  }
}

TEST_P(SurfaceLaws, affineMapsCommuteWithEvaluation)
{
  const Eigen::Affine3d map = random.affine();
  const NurbsSurface mapped = surface.transformed(map);
  for (int n = 0; n < 50; ++n) {
    const Eigen::Vector2d uv = parameter();
    EXPECT_LT((mapped.evaluate(uv.x(), uv.y()) - map * surface.evaluate(uv.x(), uv.y()))
                  .norm(),
              1e-12);
  }
}

TEST_P(SurfaceLaws, jetsAgreeWithGeneralDerivatives)
{
  for (int n = 0; n < 50; ++n) {
    const Eigen::Vector2d uv = parameter();
    const SurfaceJet1 first = surface.evaluateJet1(uv.x(), uv.y());
    const SurfaceJet2 second = surface.evaluateJet2(uv.x(), uv.y());
    const SurfaceDerivatives all = surface.derivatives(uv.x(), uv.y(), 2);
    const auto near = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return (a - b).norm() <= 1e-10 * (1.0 + b.norm());
    };
    EXPECT_TRUE(near(surface.evaluate(uv.x(), uv.y()), all(0, 0)));
    EXPECT_TRUE(near(first.position, all(0, 0)));
    EXPECT_TRUE(near(first.du, all(1, 0)));
    EXPECT_TRUE(near(first.dv, all(0, 1)));
    EXPECT_TRUE(near(second.position, all(0, 0)));
    EXPECT_TRUE(near(second.du, all(1, 0)));
    EXPECT_TRUE(near(second.dv, all(0, 1)));
    EXPECT_TRUE(near(second.duu, all(2, 0)));
    EXPECT_TRUE(near(second.duv, all(1, 1)));
    EXPECT_TRUE(near(second.dvv, all(0, 2)));
  }
}

TEST_P(SurfaceLaws, derivativesAgreeWithFiniteDifferences)
{
  const double h = 1e-6;
  for (int n = 0; n < 20; ++n) {
    const Eigen::Vector2d uv = parameter();
    // Keep the stencil in one span, where the surface is smooth.
    if (surface.knotsU().findSpan(uv.x() - h) !=
            surface.knotsU().findSpan(uv.x() + h) ||
        surface.knotsV().findSpan(uv.y() - h) != surface.knotsV().findSpan(uv.y() + h))
      continue;
    const SurfaceDerivatives d = surface.derivatives(uv.x(), uv.y(), 3);
    const SurfaceDerivatives up = surface.derivatives(uv.x() + h, uv.y(), 3);
    const SurfaceDerivatives um = surface.derivatives(uv.x() - h, uv.y(), 3);
    const SurfaceDerivatives vp = surface.derivatives(uv.x(), uv.y() + h, 3);
    const SurfaceDerivatives vm = surface.derivatives(uv.x(), uv.y() - h, 3);
    for (int k = 0; k <= 2; ++k)
      for (int l = 0; k + l <= 2; ++l) {
        const double scale = 1.0 + up(k + 1, l).norm() + vp(k, l + 1).norm();
        EXPECT_LT(((up(k, l) - um(k, l)) / (2 * h) - d(k + 1, l)).norm(), 1e-3 * scale);
        EXPECT_LT(((vp(k, l) - vm(k, l)) / (2 * h) - d(k, l + 1)).norm(), 1e-3 * scale);
      }
  }
}

TEST_P(SurfaceLaws, transposeAndReverseKeepThePoints)
{
  const NurbsSurface transposed = surface.transposed();
  const NurbsSurface reversed = surface.reversed(Direction::U).reversed(Direction::V);
  const double sum_u = surface.knotsU().domainMin() + surface.knotsU().domainMax();
  const double sum_v = surface.knotsV().domainMin() + surface.knotsV().domainMax();
  for (int n = 0; n < 50; ++n) {
    const Eigen::Vector2d uv = parameter();
    const Eigen::Vector3d point = surface.evaluate(uv.x(), uv.y());
    EXPECT_LT((transposed.evaluate(uv.y(), uv.x()) - point).norm(), 1e-12);
    EXPECT_LT((reversed.evaluate(sum_u - uv.x(), sum_v - uv.y()) - point).norm(),
              1e-11);
  }
}

TEST_P(SurfaceLaws, isoCurvesLieOnTheSurface)
{
  const Eigen::Vector2d fixed = parameter();
  const NurbsCurve3 along_v = surface.isoCurve(Direction::U, fixed.x());
  const NurbsCurve3 along_u = surface.isoCurve(Direction::V, fixed.y());
  for (int n = 0; n < 20; ++n) {
    const Eigen::Vector2d uv = parameter();
    EXPECT_LT((along_v.evaluate(uv.y()) - surface.evaluate(fixed.x(), uv.y())).norm(),
              1e-12);
    EXPECT_LT((along_u.evaluate(uv.x()) - surface.evaluate(uv.x(), fixed.y())).norm(),
              1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         SurfaceLaws,
                         testing::Combine(testing::Values(1, 2, 3, 5, 9),
                                          testing::Values(1, 3, 4),
                                          testing::Bool(),
                                          testing::Range(0, 4)));

} // namespace
