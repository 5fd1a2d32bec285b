// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Group models: planes are exact, sums add, fits are those of a dense solver.

#include <pcl/segmentation/view_polynomial.h>

#include "grid_clouds.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

const GridGeometry kCamera = GridGeometry::pinhole(96, 64, {80.0, 80.0, 47.5, 31.5});
const SensorNoise kNoise{0.002, 0.001, 0.0};

/** Range of the plane n.p = d for a camera or laser. */
struct Plane {
  Eigen::Vector3d normal;
  double distance;

  double
  along(const Eigen::Vector3d& e) const
  {
    return distance / normal.dot(e);
  }
};

const Plane kPlane{Eigen::Vector3d(0.3, -0.2, 0.9).normalized(), 1.7};
const Plane kWall{Eigen::Vector3d(0.9, 0.3, -0.1).normalized(), 8.0};

GridPoints
cameraPoints(double noise)
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  return toGridPoints(cameraCloud(kCamera,
                                  [&](int column, int row) {
                                    const Eigen::Vector3d e(
                                        kCamera.first_u + column * kCamera.step_u,
                                        kCamera.first_v + row * kCamera.step_v,
                                        1.0);
                                    return kPlane.along(e) + noise * normal(random);
                                  }),
                      kCamera);
}

GridGeometry
laserSector()
{
  GridGeometry grid = turningLaser(720, 32);
  grid.wrap = false;
  grid.width = 90;
  grid.first_u = -0.4;
  return grid;
}

GridPoints
laserPoints()
{
  const GridGeometry grid = laserSector();
  return toGridPoints(laserCloud(grid,
                                 [&](int column, int row) {
                                   return kWall.along(grid.direction(column, row));
                                 }),
                      grid);
}

ViewChart
chartOf(const GridPoints& points)
{
  GridGraph graph;
  graph.build(points, kNoise);
  return {points, kNoise, graph};
}

ViewSums
sumsOf(const ViewChart& chart, std::size_t first, std::size_t last)
{
  ViewSums sums;
  for (std::size_t cell = first; cell < last; ++cell)
    sums.add(chart.sample(cell));
  return sums;
}

void
expectExactPlane(const GridPoints& points, const Eigen::Vector3d& normal)
{
  const ViewChart chart = chartOf(points);
  const ViewSums sums = sumsOf(chart, 0, points.size());
  for (const int terms : chart.termChoices()) {
    const ViewPolynomial plane = sums.fit(terms);
    for (std::size_t cell = 0; cell < points.size(); cell += 37) {
      const ViewSample sample = chart.sample(cell);
      EXPECT_NEAR(plane(sample.basis) / sample.value, 1.0, 1e-5);
      const Eigen::Vector3d found = chart.normal(plane, sample.direction);
      EXPECT_NEAR(std::abs(found.dot(points.geometry.frame * normal)), 1.0, 1e-5);
    }
    EXPECT_LT(sums.misfit(plane), 1e-3 * sums.count());
  }
}

TEST(ViewPolynomial, planesAreExactForACamera)
{
  expectExactPlane(cameraPoints(0.0), kPlane.normal);
}

TEST(ViewPolynomial, planesAreExactForALaser)
{
  expectExactPlane(laserPoints(), kWall.normal);
}

TEST(ViewPolynomial, sumsOfPartsAreThoseOfTheWhole)
{
  const GridPoints points = cameraPoints(0.003);
  const ViewChart chart = chartOf(points);
  const ViewSums whole = sumsOf(chart, 0, points.size());
  ViewSums parts;
  for (std::size_t first = 0; first < points.size(); first += 512)
    parts += sumsOf(chart, first, std::min(first + 512, points.size()));
  EXPECT_EQ(parts.count(), whole.count());
  for (const int terms : chart.termChoices()) {
    const ViewPolynomial a = parts.fit(terms);
    const ViewPolynomial b = whole.fit(terms);
    for (std::size_t k = 0; k < a.coefficients.size(); ++k)
      EXPECT_NEAR(a.coefficients[k], b.coefficients[k], 1e-9);
    EXPECT_NEAR(parts.misfit(a) / whole.misfit(b), 1.0, 1e-7);
  }
}

TEST(ViewPolynomial, fitsAreThoseOfADenseSolver)
{
  const GridPoints points = cameraPoints(0.003);
  const ViewChart chart = chartOf(points);
  const ViewSums sums = sumsOf(chart, 0, points.size());
  for (const int terms : chart.termChoices()) {
    Eigen::MatrixXd rows(points.size(), terms);
    Eigen::VectorXd values(points.size());
    for (std::size_t cell = 0; cell < points.size(); ++cell) {
      const ViewSample sample = chart.sample(cell);
      const double root = std::sqrt(sample.weight);
      const auto k = static_cast<Eigen::Index>(cell);
      for (int term = 0; term < terms; ++term)
        rows(k, term) = root * sample.basis[static_cast<std::size_t>(term)];
      values(k) = root * sample.value;
    }
    const Eigen::VectorXd best = rows.householderQr().solve(values);
    const double misfit = (rows * best - values).squaredNorm();
    const ViewPolynomial fit = sums.fit(terms);
    EXPECT_NEAR(sums.misfit(fit) / misfit, 1.0, 1e-6);
    for (int term = 0; term < terms; ++term)
      EXPECT_NEAR(fit.coefficients[static_cast<std::size_t>(term)], best(term), 1e-6);
  }
}

TEST(ViewPolynomial, tooFewPointsGiveFiniteFits)
{
  const GridPoints points = cameraPoints(0.003);
  const ViewChart chart = chartOf(points);
  EXPECT_EQ(ViewSums().fit(10).coefficients, ViewPolynomial().coefficients);
  EXPECT_EQ(ViewSums().misfit(ViewSums().fit(3)), 0.0);
  for (std::size_t count = 1; count < 5; ++count) {
    const ViewSums sums = sumsOf(chart, 0, count);
    const ViewPolynomial fit = sums.fit(10);
    for (const double coefficient : fit.coefficients)
      EXPECT_TRUE(std::isfinite(coefficient));
    EXPECT_LT(sums.misfit(fit), 10.0 * static_cast<double>(count));
  }
}

TEST(ViewPolynomial, noiseScaleMultipliesTheNoise)
{
  const GridPoints points = cameraPoints(0.0);
  ViewChart chart = chartOf(points);
  const double before = chart.sigma(7);
  chart.scaleNoise(3.0);
  EXPECT_DOUBLE_EQ(chart.sigma(7), 3.0 * before);
  EXPECT_THROW(chart.scaleNoise(0.0), std::invalid_argument);
  EXPECT_THROW(ViewChart(points, kNoise, GridGraph()), std::invalid_argument);
}

TEST(ViewPolynomial, grazingSurfacesAreNoisier)
{
  const auto depths = [](double slope) {
    return toGridPoints(
        cameraCloud(kCamera,
                    [slope](int column, int) { return 1.0 + slope * (column - 48); }),
        kCamera);
  };
  const GridPoints facing = depths(0.0);
  const GridPoints grazing = depths(0.015);
  const std::size_t middle = 20 * 96 + 48;
  const double sensor = kNoise.sigma(1.0);
  EXPECT_NEAR(chartOf(facing).sigma(middle), sensor, 0.1 * sensor);
  EXPECT_NEAR(chartOf(grazing).sigma(middle),
              std::hypot(chartOf(facing).sigma(middle), 0.1 * 0.015),
              0.02 * sensor);
}

} // namespace
