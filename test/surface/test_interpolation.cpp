// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Fits pass through their points, reproduce what they can represent, and minimise what
// they say they minimise (against dense solvers).

#include <pcl/surface/nurbs/interpolation.h>

#include "fit_support.h"
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
using pcl::nurbs::test::collocation;
using pcl::nurbs::test::evenParameters;
using pcl::nurbs::test::maxDistance;
using pcl::nurbs::test::RandomNurbs;
using pcl::nurbs::test::walk;

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
