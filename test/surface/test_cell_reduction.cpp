// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Linear fits against a dense least-squares solution made from rows of basis functions:
// the reduction of knot cells to a few moments must not change the answer.

#include "fit_points.h"
#include "random_nurbs.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

namespace {

using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

/** Row of tensor-product basis functions at one parameter. */
Eigen::RowVectorXd
basisRow(const KnotVector& u, const KnotVector& v, const Eigen::Vector2d& at)
{
  Eigen::RowVectorXd row =
      Eigen::RowVectorXd::Zero(u.numControlPoints() * v.numControlPoints());
  BasisValues a;
  BasisValues b;
  const int span_u = u.findSpan(at.x());
  const int span_v = v.findSpan(at.y());
  u.evaluateBasis(span_u, at.x(), a);
  v.evaluateBasis(span_v, at.y(), b);
  for (int i = 0; i <= u.degree(); ++i)
    for (int j = 0; j <= v.degree(); ++j)
      row((span_u - u.degree() + i) * v.numControlPoints() + span_v - v.degree() + j) =
          a[i] * b[j];
  return row;
}

/** Homogeneous control points with given weights, by QR of all rows. */
Eigen::MatrixXd
denseFit(const KnotVector& u,
         const KnotVector& v,
         const FitPoints& points,
         const Eigen::VectorXd& weights)
{
  Eigen::MatrixXd rows(points.positions.cols(), weights.size());
  Eigen::MatrixXd targets(points.positions.cols(), 3);
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    const Eigen::RowVectorXd basis = basisRow(u, v, points.parameters.col(k));
    const double weight = basis * weights;
    rows.row(k) = basis / (weight * points.sigma(k));
    targets.row(k) = points.positions.col(k).transpose() / points.sigma(k);
  }
  return rows.colPivHouseholderQr().solve(targets);
}

struct Case {
  KnotVector u;
  KnotVector v;
  bool rational;
};

std::vector<Case>
cases()
{
  return {{KnotVector::bezier(1, -1, 1), KnotVector::bezier(1, -1, 1), false},
          {KnotVector::clampedUniform(3, 5, -1, 1),
           KnotVector::clamped(2, {-1, -0.3, 0.5, 1}),
           true},
          {KnotVector::bezier(5, -1, 1), KnotVector::clampedUniform(1, 6, -1, 1), true},
          {KnotVector(2, {-1, -1, -1, 0.1, 0.1, 1, 1, 1}),
           KnotVector::clampedUniform(4, 3, -1, 1),
           false}};
}

TEST(CellReduction, EqualsDenseLeastSquares)
{
  unsigned seed = 1;
  for (const Case& c : cases())
    for (LinearSolver solver : {LinearSolver::Ceres, LinearSolver::Cholesky}) {
      RandomNurbs random(++seed);
      FitPoints points = scattered(wave, 3000, seed);
      points.sigma.resize(points.positions.cols());
      for (Eigen::Index k = 0; k < points.sigma.size(); ++k) {
        points.sigma(k) = random.uniform(0.5, 2.0);
        points.positions.col(k).z() += random.normal(0.1);
      }
      const int n_v = c.v.numControlPoints();
      Eigen::VectorXd weights = Eigen::VectorXd::Ones(c.u.numControlPoints() * n_v);
      for (double& weight : weights)
        weight = c.rational ? random.uniform(0.5, 2.0) : 1.0;
      SurfaceFitOptions options;
      options.fairness = 0.0;
      options.distance = FitDistance::Parametric;
      options.linear_solver = solver;
      const SurfaceFit fit = fitParametric(c.u, c.v, points, options, {}, weights);
      const Eigen::MatrixXd expected = denseFit(c.u, c.v, points, weights);
      const Eigen::MatrixXd found =
          fit.surface.homogeneousPoints().topRows(3).transpose();
      EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-10);
    }
}

TEST(CellReduction, SplineSurfacesAreReproduced)
{
  unsigned seed = 10;
  for (const Case& c : cases()) {
    const int count = c.u.numControlPoints() * c.v.numControlPoints();
    std::srand(++seed);
    const NurbsSurface truth =
        NurbsSurface::fromControlPoints(c.u, c.v, Eigen::Matrix3Xd::Random(3, count));
    const FitPoints points =
        scattered([&](double u, double v) { return truth.evaluate(u, v); }, 4000, seed);
    SurfaceFitOptions options;
    options.fairness = 0.0;
    options.distance = FitDistance::Parametric;
    const SurfaceFit fit = fitParametric(c.u, c.v, points, options);
    EXPECT_LT(largestDifference(truth, fit.surface), 2e-12);
    EXPECT_LT(fit.report.max, 2e-12);
  }
}

TEST(CellReduction, ThreadsDoNotChangeABit)
{
  FitPoints points = scattered(wave, 20000, 3);
  addNoise(points, 0.002, 3);
  const KnotVector knots = KnotVector::clampedUniform(3, 7, -1, 1);
  for (FitDistance distance :
       {FitDistance::Parametric, FitDistance::Alternating, FitDistance::Orthogonal}) {
    SurfaceFitOptions options;
    options.distance = distance;
    options.linear_solver = LinearSolver::Cholesky;
    options.threads = 1;
    const SurfaceFit one = fitParametric(knots, knots, points, options);
    options.threads = 2;
    const SurfaceFit two = fitParametric(knots, knots, points, options);
    EXPECT_EQ(one.surface.homogeneousPoints(), two.surface.homogeneousPoints());
    EXPECT_EQ(one.parameters, two.parameters);
    EXPECT_EQ(one.report.rmse, two.report.rmse);
  }
}

} // namespace
