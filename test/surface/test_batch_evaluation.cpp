// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/batch_evaluation.h>

#include "exact_shapes.h"
#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::RandomNurbs;

/** Coordinates of n vectors. */
struct Vectors {
  explicit Vectors(std::size_t n) : x(n, -77.0), y(n, -77.0), z(n, -77.0) {}

  CoordinateArrays
  arrays()
  {
    return {x.data(), y.data(), z.data()};
  }

  Eigen::Vector3d
  operator[](std::size_t i) const
  {
    return {x[i], y[i], z[i]};
  }

  std::vector<double> x, y, z;
};

void
expectNear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double relative)
{
  EXPECT_LE((a - b).norm(), relative * (1.0 + b.norm()));
}

class BatchLaws : public testing::TestWithParam<std::tuple<int, int, bool, int>> {};

TEST_P(BatchLaws, agreesWithSingleCalls)
{
  RandomNurbs random(83);
  const auto [p, q, rational, kind] = GetParam();
  const NurbsSurface surface =
      random.surface(p, q, rational, static_cast<test::KnotKind>(kind));
  for (const std::size_t n : {0, 1, 3, 4, 131}) {
    std::vector<double> u(n);
    std::vector<double> v(n);
    for (std::size_t i = 0; i < n; ++i) {
      // Knots and both ends of the domain among them.
      const std::vector<double> breaks = surface.knotsU().breaks();
      u[i] = i % 5 == 0 ? breaks[i % breaks.size()] : random.inDomain(surface.knotsU());
      v[i] =
          i % 7 == 0 ? surface.knotsV().domainMax() : random.inDomain(surface.knotsV());
    }
    Vectors only_points(n), points(n), du(n), dv(n), again(n), normals(n);
    evaluateBatch(surface, n, u.data(), v.data(), only_points.arrays());
    evaluateJet1Batch(
        surface, n, u.data(), v.data(), points.arrays(), du.arrays(), dv.arrays());
    evaluateNormalBatch(
        surface, n, u.data(), v.data(), again.arrays(), normals.arrays());
    for (std::size_t i = 0; i < n; ++i) {
      const SurfaceJet1 jet = surface.evaluateJet1(u[i], v[i]);
      expectNear(only_points[i], jet.position, 1e-14);
      expectNear(points[i], jet.position, 1e-14);
      expectNear(again[i], jet.position, 1e-14);
      const double slope = 1e-13 * (1.0 + jet.du.norm() + jet.dv.norm());
      EXPECT_LE((du[i] - jet.du).norm(), slope);
      EXPECT_LE((dv[i] - jet.dv).norm(), slope);
      expectNear(normals[i], surface.normal(u[i], v[i]), 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         BatchLaws,
                         testing::Combine(testing::Values(1, 2, 3, 5, 9),
                                          testing::Values(1, 2, 3, 4),
                                          testing::Bool(),
                                          testing::Range(0, 4)));

TEST(BatchEvaluation, normalsAtPolesAreLimits)
{
  const NurbsSurface sphere = test::sphere(1.0);
  const double u[] = {0.0, 2.0, 1.0};
  const double v[] = {0.3, 2.7, 1.0};
  Vectors points(3), normals(3);
  evaluateNormalBatch(sphere, 3, u, v, points.arrays(), normals.arrays());
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(std::abs(normals[i].dot(points[i])), 1.0, 1e-7);
}

} // namespace
