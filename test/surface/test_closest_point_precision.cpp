// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Descent from a close start ends as soon as what is left is negligible: the foot point
// must be as good as one that was iterated until nothing moved.

#include <pcl/surface/nurbs/closest_point.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace pcl::nurbs;

/** Wavy surface over [-1, 1]^2; weights bend the parameters. */
NurbsSurface
wavySurface(const KnotVector& knots, double weight_range)
{
  const int n = knots.numControlPoints();
  Eigen::Matrix3Xd points(3, n * n);
  Eigen::VectorXd weights(n * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = knots.greville(i);
      const double y = knots.greville(j);
      points.col(i * n + j) << x, y, 0.25 * std::sin(3.0 * x) * std::cos(2.0 * y);
      weights(i * n + j) = 1.0 + weight_range * std::sin(5.0 * i + 3.0 * j);
    }
  return NurbsSurface::fromControlPoints(knots, knots, points, weights);
}

class WarmStart : public testing::TestWithParam<int> {
protected:
  /** Offsets of known surface points along their normals lead back to them. */
  static void
  expectFeet(const NurbsSurface& surface, unsigned seed)
  {
    const ClosestPointFinder finder(surface);
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (double offset : {1e-3, 0.02, 0.1})
      for (int k = 0; k < 300; ++k) {
        const double u = 0.9 * uniform(engine);
        const double v = 0.9 * uniform(engine);
        const double distance = offset * uniform(engine);
        const Eigen::Vector3d point =
            surface.evaluate(u, v) + distance * surface.normal(u, v);
        const ClosestPoint foot = finder.findFrom(
            point, u + 0.01 * uniform(engine), v + 0.01 * uniform(engine));
        ASSERT_TRUE(foot.converged);
        ASSERT_NEAR(foot.u, u, 2e-11);
        ASSERT_NEAR(foot.v, v, 2e-11);
        ASSERT_NEAR(foot.signed_distance, distance, 1e-13);
        ASSERT_LT((foot.point - surface.evaluate(foot.u, foot.v)).norm(), 1e-13);
      }
  }
};

TEST_P(WarmStart, Polynomial)
{
  const int degree = GetParam();
  expectFeet(wavySurface(KnotVector::clampedUniform(degree, 9, -1.0, 1.0), 0.0), 1);
}

TEST_P(WarmStart, Rational)
{
  const int degree = GetParam();
  expectFeet(wavySurface(KnotVector::clampedUniform(degree, 9, -1.0, 1.0), 0.02), 2);
}

TEST_P(WarmStart, CurvatureJumpsAtInnerKnots)
{
  const int degree = GetParam();
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, -1.0);
  for (double inner : {-0.4, 0.1, 0.6})
    knots.insert(knots.end(), static_cast<std::size_t>(degree - 1), inner);
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, 1.0);
  expectFeet(wavySurface(KnotVector(degree, knots), 0.0), 3);
}

INSTANTIATE_TEST_SUITE_P(Degrees, WarmStart, testing::Values(2, 3, 4, 5));

} // namespace
