// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Surfaces fitted to grids pass through their points, reproduce what they can represent
// and are the least-squares solution of all points.

#include <pcl/surface/nurbs/interpolation.h>

#include "fit_support.h"
#include "geometry_distance.h"
#include "random_nurbs.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::collocation;
using pcl::nurbs::test::evenParameters;
using pcl::nurbs::test::maxDistance;
using pcl::nurbs::test::RandomNurbs;
using pcl::nurbs::test::walk;

/** Grid of points of a surface at even parameters. */
PointGrid
sampled(const NurbsSurface& surface,
        const std::vector<double>& u,
        const std::vector<double>& v)
{
  PointGrid grid{Eigen::Matrix3Xd(3, u.size() * v.size()),
                 static_cast<int>(u.size()),
                 static_cast<int>(v.size())};
  for (int i = 0; i < grid.count_u; ++i)
    for (int j = 0; j < grid.count_v; ++j)
      grid.points.col(i * grid.count_v + j) = surface.evaluate(u[i], v[j]);
  return grid;
}

class SurfaceFits : public testing::TestWithParam<std::tuple<int, int>> {
protected:
  RandomNurbs random{71};
  const int p = std::get<0>(GetParam());
  const int q = std::get<1>(GetParam());
  NurbsSurface surface = random.surface(p, q, false, test::KnotKind::ClampedRandom);
  std::vector<double> u =
      evenParameters(90, surface.knotsU().domainMin(), surface.knotsU().domainMax());
  std::vector<double> v =
      evenParameters(80, surface.knotsV().domainMin(), surface.knotsV().domainMax());
};

TEST_P(SurfaceFits, interpolationRunsThroughTheGrid)
{
  PointGrid grid = sampled(surface,
                           evenParameters(13, u.front(), u.back()),
                           evenParameters(11, v.front(), v.back()));
  const NurbsSurface fit = interpolateSurface(grid, p, q);
  const auto fit_u =
      spreadParameters(grid, Direction::U, Parameterization::ChordLength);
  const auto fit_v =
      spreadParameters(grid, Direction::V, Parameterization::ChordLength);
  for (int i = 0; i < grid.count_u; ++i)
    for (int j = 0; j < grid.count_v; ++j)
      EXPECT_LT((fit.evaluate(fit_u[i], fit_v[j]) - grid.points.col(i * 11 + j)).norm(),
                1e-10);
}

TEST_P(SurfaceFits, leastSquaresReproducesItsOwnSpace)
{
  const PointGrid grid = sampled(surface, u, v);
  for (bool fix_ends : {true, false}) {
    const NurbsSurface fit =
        approximateSurface(grid, u, v, surface.knotsU(), surface.knotsV(), fix_ends);
    EXPECT_LT(maxDistance(fit, surface), 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         SurfaceFits,
                         testing::Combine(testing::Values(1, 2, 3, 5),
                                          testing::Values(1, 3, 4)));

TEST(SurfaceFit, equalsTheDenseSolutionOfAllPoints)
{
  RandomNurbs random{73};
  const KnotVector knots_u = KnotVector::clampedUniform(2, 2);
  const KnotVector knots_v = KnotVector::clampedUniform(3, 3);
  const auto u = evenParameters(12);
  const auto v = evenParameters(15);
  const PointGrid grid{walk(random, 180), 12, 15};
  const NurbsSurface fit = approximateSurface(grid, u, v, knots_u, knots_v, false);
  const Eigen::MatrixXd a = collocation(knots_u, u);
  const Eigen::MatrixXd b = collocation(knots_v, v);
  Eigen::MatrixXd all(180, a.cols() * b.cols());
  for (Eigen::Index i = 0; i < 12; ++i)
    for (Eigen::Index k = 0; k < a.cols(); ++k)
      all.block(i * 15, k * b.cols(), 15, b.cols()) = a(i, k) * b;
  const Eigen::MatrixXd x =
      all.colPivHouseholderQr().solve(grid.points.transpose()).transpose();
  EXPECT_LT((fit.homogeneousPoints().topRows(3) - x).norm(), 1e-10 * x.norm());
}

TEST(SurfaceFit, polesDoNotCountForParameters)
{
  PointGrid grid{Eigen::Matrix3Xd::Zero(3, 9), 3, 3}; // line i = 0 is one point
  for (int i = 1; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      grid.points.col(3 * i + j) << i, i * j * j, 0;
  const auto v = spreadParameters(grid, Direction::V, Parameterization::ChordLength);
  EXPECT_EQ(v, (std::vector<double>{0, 0.25, 1}));
  const NurbsSurface surface = interpolateSurface(grid, 2, 2);
  EXPECT_LT(surface.evaluate(0.0, 0.7).norm(), 1e-14);
}

} // namespace
