// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/surface_fitter.h>

#include <Eigen/Core>

#include <cmath>
#include <random>

namespace pcl {
namespace nurbs {
namespace test {

/** Points position(u, v) at random parameters of [-1, 1]² times \a half. */
template <typename Position>
FitPoints
scattered(Position position, int count, unsigned seed, double half = 1.0)
{
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(-half, half);
  FitPoints points;
  points.positions.resize(3, count);
  points.parameters.resize(2, count);
  for (int k = 0; k < count; ++k) {
    const double u = uniform(engine);
    const double v = uniform(engine);
    points.parameters.col(k) << u, v;
    points.positions.col(k) = position(u, v);
  }
  return points;
}

/** Add noise along z and state it. */
inline void
addNoise(FitPoints& points, double sigma, unsigned seed)
{
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  for (Eigen::Index k = 0; k < points.positions.cols(); ++k)
    points.positions(2, k) += sigma * normal(engine);
  points.sigma.setConstant(points.positions.cols(), sigma);
}

inline Eigen::Vector3d
wave(double u, double v)
{
  return {u, v, 0.25 * std::sin(3.0 * u) * std::cos(2.0 * v)};
}

/** RMS of f(x, y) - z over a lattice of the surface. */
template <typename Height>
double
heightRms(const NurbsSurface& surface, Height height)
{
  constexpr int kSteps = 60;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const KnotVector& u = surface.knotsU();
      const KnotVector& v = surface.knotsV();
      const Eigen::Vector3d p =
          surface.evaluate(u.domainMin() + u.domainLength() * (i + 0.5) / kSteps,
                           v.domainMin() + v.domainLength() * (j + 0.5) / kSteps);
      sum += std::pow(p.z() - height(p.x(), p.y()), 2);
    }
  return std::sqrt(sum) / kSteps;
}

inline double
waveRms(const NurbsSurface& surface)
{
  return heightRms(surface, [](double x, double y) { return wave(x, y).z(); });
}

/** Largest distance between two surfaces at the same parameters of the first. */
inline double
largestDifference(const NurbsSurface& a, const NurbsSurface& b)
{
  double largest = 0.0;
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j) {
      const double u = a.knotsU().domainMin() + a.knotsU().domainLength() * i / 20.0;
      const double v = a.knotsV().domainMin() + a.knotsV().domainLength() * j / 20.0;
      largest = std::max(largest, (a.evaluate(u, v) - b.evaluate(u, v)).norm());
    }
  return largest;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
