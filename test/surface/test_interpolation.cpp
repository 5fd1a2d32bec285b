// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Fits pass through their points, reproduce what they can represent, and minimise what
// they say they minimise (against dense solvers).

#include <pcl/surface/nurbs/interpolation.h>

#include "geometry_distance.h"
#include "random_nurbs.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace {

using namespace pcl::nurbs;
using pcl::nurbs::test::maxDistance;
using pcl::nurbs::test::RandomNurbs;

std::vector<double>
evenParameters(int count, double first = 0.0, double last = 1.0)
{
  std::vector<double> parameters;
  for (int i = 0; i < count; ++i)
    parameters.push_back(i + 1 == count ? last
                                        : first + (last - first) * i / (count - 1));
  return parameters;
}

Eigen::Matrix3Xd
walk(RandomNurbs& random, int count)
{
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i)
    points.col(i) << i + random.uniform(-0.3, 0.3), random.normal(1.0),
        random.normal(1.0);
  return points;
}

Eigen::MatrixXd
collocation(const KnotVector& knots, const std::vector<double>& parameters)
{
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(
      static_cast<Eigen::Index>(parameters.size()), knots.numControlPoints());
  for (Eigen::Index k = 0; k < matrix.rows(); ++k) {
    const int span = knots.findSpan(parameters[k]);
    BasisValues basis;
    knots.evaluateBasis(span, parameters[k], basis);
    for (int r = 0; r <= knots.degree(); ++r)
      matrix(k, span - knots.degree() + r) = basis[r];
  }
  return matrix;
}

class CurveFits : public testing::TestWithParam<std::tuple<int, Parameterization>> {
protected:
  RandomNurbs random{59};
  const int degree = std::get<0>(GetParam());
  const Parameterization parameterization = std::get<1>(GetParam());
};

TEST_P(CurveFits, interpolationRunsThroughThePoints)
{
  for (int count : {degree + 1, degree + 2, 25}) {
    const Eigen::Matrix3Xd points = walk(random, count);
    const NurbsCurve3 curve = interpolateCurve<3>(points, degree, parameterization);
    EXPECT_EQ(curve.degree(), degree);
    EXPECT_FALSE(curve.isRational());
    const std::vector<double> u = spreadParameters<3>(points, parameterization);
    for (int i = 0; i < count; ++i)
      EXPECT_LT((curve.evaluate(u[i]) - points.col(i)).norm(), 1e-10);
    EXPECT_EQ(curve.controlPoint(0), points.col(0));
    EXPECT_EQ(curve.controlPoint(count - 1), points.col(count - 1));
  }
}

TEST_P(CurveFits, interpolationOfAPolynomialIsThePolynomial)
{
  const NurbsCurve3 polynomial = random.curve<3>(degree, false, test::KnotKind::Bezier);
  const std::vector<double> u = evenParameters(
      17, polynomial.knots().domainMin(), polynomial.knots().domainMax());
  Eigen::Matrix3Xd points(3, 17);
  for (int i = 0; i < 17; ++i)
    points.col(i) = polynomial.evaluate(u[i]);
  const NurbsCurve3 curve =
      interpolateCurve<3>(points, u, interpolationKnots(degree, u));
  EXPECT_LT(maxDistance(curve, polynomial), 1e-11);
}

TEST_P(CurveFits, approximationFollowsThePoints)
{
  const Eigen::Matrix3Xd points = walk(random, 60);
  const NurbsCurve3 curve =
      approximateCurve<3>(points, degree, degree + 6, parameterization);
  EXPECT_EQ(curve.numControlPoints(), degree + 6);
  EXPECT_EQ(curve.controlPoint(0), points.col(0));
  EXPECT_EQ(curve.controlPoint(degree + 5), points.col(59));
  const NurbsCurve3 through = approximateCurve<3>(points, degree, 60, parameterization);
  const std::vector<double> u = spreadParameters<3>(points, parameterization);
  for (int i = 0; i < 60; ++i)
    EXPECT_LT((through.evaluate(u[i]) - points.col(i)).norm(), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(
    Degrees,
    CurveFits,
    testing::Combine(testing::Values(1, 2, 3, 4, 5, 7, 9),
                     testing::Values(Parameterization::Uniform,
                                     Parameterization::ChordLength,
                                     Parameterization::Centripetal)));

class LeastSquares : public testing::TestWithParam<std::tuple<int, int>> {
protected:
  RandomNurbs random{61};
  KnotVector knots = random.knots(std::get<0>(GetParam()),
                                  static_cast<test::KnotKind>(std::get<1>(GetParam())));
  const int count = 15 * knots.numControlPoints();
  std::vector<double> u = evenParameters(count, knots.domainMin(), knots.domainMax());
};

TEST_P(LeastSquares, reproducesItsOwnSpace)
{
  Eigen::Matrix3Xd control(3, knots.numControlPoints());
  for (Eigen::Index i = 0; i < control.cols(); ++i)
    control.col(i) << random.normal(1.0), random.normal(1.0), random.normal(1.0);
  const auto truth = NurbsCurve3::fromControlPoints(knots, control);
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i)
    points.col(i) = truth.evaluate(u[i]);
  CurveFitOptions options;
  options.fix_ends = knots.isClamped();
  const NurbsCurve3 curve = approximateCurve<3>(points, u, knots, options);
  EXPECT_LT(maxDistance(curve, truth), 1e-11);
}

TEST_P(LeastSquares, equalsTheDenseWeightedSolution)
{
  const Eigen::Matrix3Xd points = walk(random, count);
  CurveFitOptions options;
  options.fix_ends = false;
  options.weights.resize(count);
  for (int i = 0; i < count; ++i)
    options.weights(i) = random.uniform(0.1, 10.0);
  const NurbsCurve3 curve = approximateCurve<3>(points, u, knots, options);
  const Eigen::VectorXd root = options.weights.cwiseSqrt();
  const Eigen::MatrixXd a = root.asDiagonal() * collocation(knots, u);
  const Eigen::MatrixXd b = root.asDiagonal() * points.transpose();
  const Eigen::MatrixXd x = a.colPivHouseholderQr().solve(b);
  EXPECT_LT((curve.homogeneousPoints().topRows(3) - x.transpose()).norm(),
            1e-9 * x.norm());
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         LeastSquares,
                         testing::Combine(testing::Values(1, 2, 3, 5, 9),
                                          testing::Values(0, 1, 3)));

TEST(Interpolation, fixedEndsGiveTheConstrainedMinimum)
{
  RandomNurbs random{67};
  const KnotVector knots = KnotVector::clampedUniform(3, 5);
  const Eigen::Matrix3Xd points = walk(random, 40);
  const std::vector<double> u = evenParameters(40);
  const NurbsCurve3 curve = approximateCurve<3>(points, u, knots);
  const Eigen::MatrixXd a = collocation(knots, u);
  const Eigen::MatrixXd residual =
      a * curve.homogeneousPoints().topRows(3).transpose() - points.transpose();
  const Eigen::MatrixXd gradient = a.middleCols(1, 6).transpose() * residual;
  EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_EQ(curve.controlPoint(0), points.col(0));
}

TEST(Interpolation, parametersFollowTheirDefinition)
{
  Eigen::Matrix2Xd points(2, 3);
  points << 0, 1, 10, //
      0, 0, 0;
  EXPECT_EQ(spreadParameters<2>(points, Parameterization::Uniform),
            (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(spreadParameters<2>(points, Parameterization::ChordLength),
            (std::vector<double>{0, 0.1, 1}));
  EXPECT_EQ(spreadParameters<2>(points, Parameterization::Centripetal),
            (std::vector<double>{0, 0.25, 1}));
}

TEST(Interpolation, knotsFollowTheirDefinition)
{
  const std::vector<double> u{0, 1, 2, 4, 7, 10};
  EXPECT_EQ(interpolationKnots(3, u).values(),
            (std::vector<double>{0, 0, 0, 0, 7.0 / 3, 13.0 / 3, 10, 10, 10, 10}));
  EXPECT_EQ(approximationKnots(3, u, 6), interpolationKnots(3, u));
  EXPECT_EQ(approximationKnots(1, u, 3).values(), // halfway between t_2 and t_3
            (std::vector<double>{0, 0, 3, 10, 10}));
  EXPECT_EQ(approximationKnots(2, u, 5).values(), // over 0, 1.25, 3, 6.25, 10
            (std::vector<double>{0, 0, 0, 2.125, 4.625, 10, 10, 10}));
}

TEST(Interpolation, chosenKnotsAlwaysDetermineTheFit)
{
  RandomNurbs random{79};
  for (int n = 0; n < 300; ++n) {
    const int degree = random.integer(1, kMaxDegree);
    const int control_points = random.integer(degree + 1, degree + 20);
    const int count = control_points + random.integer(0, 20);
    std::vector<double> u{0.0};
    for (int i = 1; i < count; ++i)
      u.push_back(u.back() + std::exp(random.uniform(-4.0, 4.0)));
    const KnotVector knots = approximationKnots(degree, u, control_points);
    // Schoenberg-Whitney: for every control point an own parameter in its support.
    std::size_t k = 0;
    for (int i = 0; i < control_points; ++i, ++k) {
      const bool first = i == 0;
      const bool last = i == control_points - 1;
      while (k < u.size() && !(first || u[k] > knots[i]))
        ++k;
      ASSERT_TRUE(k < u.size() && (last || u[k] < knots[i + degree + 1]));
    }
  }
}

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

TEST(Interpolation, badInputThrows)
{
  using Points = PointSequence<2>;
  Points points = Points::Random(2, 5);
  const std::vector<double> u = evenParameters(5);
  const KnotVector knots = interpolationKnots(3, u);
  Points twice = points;
  twice.col(2) = twice.col(1);
  EXPECT_THROW(interpolateCurve<2>(twice, 3), std::invalid_argument);
  EXPECT_NO_THROW(interpolateCurve<2>(twice, 3, Parameterization::Uniform));
  EXPECT_THROW(interpolateCurve<2>(points, 5), std::invalid_argument);
  EXPECT_THROW(interpolateCurve<2>(points, 0), std::invalid_argument);
  EXPECT_THROW(interpolateCurve<2>(Points::Zero(2, 4), 3), std::invalid_argument);
  EXPECT_THROW(interpolateCurve<2>(Points(2, 0), 1), std::invalid_argument);
  EXPECT_THROW(interpolateCurve<2>(points, evenParameters(4), knots),
               std::invalid_argument);
  EXPECT_THROW(interpolateCurve<2>(points, evenParameters(5, 0.0, 2.0), knots),
               std::invalid_argument);
  EXPECT_THROW(approximateCurve<2>(points, 3, 3), std::invalid_argument);
  EXPECT_THROW(approximateCurve<2>(points, 3, 6), std::invalid_argument);
  CurveFitOptions options;
  options.weights = Eigen::VectorXd::Zero(5);
  EXPECT_THROW(approximateCurve<2>(points, u, knots, options), std::invalid_argument);
  EXPECT_THROW(approximateCurve<2>(points, evenParameters(5, 0.1, 1.0), knots),
               std::invalid_argument);
  points(0, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(interpolateCurve<2>(points, 3), std::invalid_argument);
  EXPECT_THROW(interpolateSurface(PointGrid{Eigen::Matrix3Xd::Zero(3, 5), 2, 2}, 1, 1),
               std::invalid_argument);
}

TEST(Interpolation, undeterminedControlPointsThrow)
{
  const PointSequence<2> points = PointSequence<2>::Random(2, 6);
  // No parameter in [0.5, 1): the point that rules there alone is free.
  const std::vector<double> crowded{0, 0.1, 0.2, 0.3, 0.4, 1};
  EXPECT_THROW(approximateCurve<2>(points, crowded, KnotVector::clampedUniform(1, 4)),
               std::domain_error);
  EXPECT_THROW(interpolateCurve<2>(points, crowded, KnotVector::clampedUniform(1, 5)),
               std::domain_error);
}

} // namespace
