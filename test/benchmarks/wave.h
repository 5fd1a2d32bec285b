// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// The surface of all benchmarks, z = 0.25 sin 3x cos 2y on [-1, 1]^2 (metres), its
// noisy samples, and how far a fit is from it.

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <Eigen/Core>

#include <cmath>
#include <random>

namespace pcl {
namespace nurbs {
namespace bench {

/** \brief Control points per direction of the surfaces that are fitted or evaluated. */
constexpr int kNet = 34;

/** \brief Standard deviation of the noise in z, metres. */
constexpr double kNoise = 0.002;

inline double
waveHeight(double x, double y)
{
  return 0.25 * std::sin(3.0 * x) * std::cos(2.0 * y);
}

/** \brief \a count samples at random (x, y), one column each, with noise in z. */
inline Eigen::Matrix3Xd
waveSamples(int count, double noise = kNoise, unsigned seed = 20260101)
{
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  std::normal_distribution<double> error(0.0, 1.0);
  Eigen::Matrix3Xd samples(3, count);
  for (auto&& sample : samples.colwise()) {
    const double x = side(engine);
    const double y = side(engine);
    sample << x, y, waveHeight(x, y) + noise * error(engine);
  }
  return samples;
}

/** \brief A \a net x \a net surface of \a degree that follows the wave; \a rational
 * adds weights between 0.7 and 1.3. */
inline NurbsSurface
waveSurface(int degree = 3, bool rational = false, int net = kNet)
{
  const KnotVector knots = KnotVector::clampedUniform(degree, net - degree, -1.0, 1.0);
  Eigen::Matrix3Xd points(3, net * net);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(points.cols());
  for (int i = 0; i < net; ++i)
    for (int j = 0; j < net; ++j) {
      const double x = knots.greville(i);
      const double y = knots.greville(j);
      points.col(i * net + j) << x, y, waveHeight(x, y);
      if (rational)
        weights(i * net + j) = 1.0 + 0.3 * std::sin(5.0 * x + 7.0 * y);
    }
  return NurbsSurface::fromControlPoints(knots, knots, points, weights);
}

/** \brief Random parameters inside of [-1, 1]^2, one column each. */
inline Eigen::Matrix2Xd
randomParameters(int count, unsigned seed = 7)
{
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  return Eigen::Matrix2Xd::NullaryExpr(2, count, [&] { return side(engine); });
}

/** \brief Root mean square over [-1, 1]^2 of the height of \a surface above the wave.
 * \param[in] surface maps (u, v) in [-1, 1]^2 to a point; 401 x 401 parameters are
 * used, none of which is a sample */
template <typename Surface>
double
truthRms(const Surface& surface)
{
  constexpr int kSteps = 400;
  double sum = 0.0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector3d point =
          surface(-1.0 + 2.0 * i / kSteps, -1.0 + 2.0 * j / kSteps);
      sum += std::pow(point.z() - waveHeight(point.x(), point.y()), 2);
    }
  return std::sqrt(sum / ((kSteps + 1.0) * (kSteps + 1.0)));
}

} // namespace bench
} // namespace nurbs
} // namespace pcl
