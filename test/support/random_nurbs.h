// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

/** Families of knot vectors that the laws are checked on. */
enum class KnotKind { Bezier, ClampedRandom, ClampedRepeated, Periodic };

/** Seeded source of random curves and surfaces of every kind. */
class RandomNurbs {
public:
  explicit RandomNurbs(unsigned seed) : engine_(seed) {}

  double
  uniform(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

  double
  normal(double sigma)
  {
    return sigma * std::normal_distribution<double>()(engine_);
  }

  int
  integer(int low, int high)
  {
    return std::uniform_int_distribution<int>(low, high)(engine_);
  }

  KnotVector
  knots(int degree, KnotKind kind)
  {
    const double first = uniform(-2.0, 1.0);
    const double last = first + uniform(0.5, 4.0);
    if (kind == KnotKind::Bezier)
      return KnotVector::bezier(degree, first, last);
    if (kind == KnotKind::Periodic)
      return KnotVector::periodicUniform(degree, degree + integer(1, 4), first, last);
    std::vector<double> inner;
    for (int i = integer(1, 5); i > 0; --i) {
      const double knot = first + (last - first) * uniform(0.1, 0.9);
      const int times = kind == KnotKind::ClampedRepeated ? integer(1, degree) : 1;
      inner.insert(inner.end(), static_cast<std::size_t>(times), knot);
    }
    std::vector<double> all(static_cast<std::size_t>(degree) + 1, first);
    std::sort(inner.begin(), inner.end());
    all.insert(all.end(), inner.begin(), inner.end());
    all.insert(all.end(), static_cast<std::size_t>(degree) + 1, last);
    return {degree, std::move(all)};
  }

  template <int Dim>
  NurbsCurve<Dim>
  curve(int degree, bool rational, KnotKind kind)
  {
    KnotVector u = knots(degree, kind);
    typename NurbsCurve<Dim>::Points points(Dim, u.numControlPoints());
    Eigen::VectorXd weights(points.cols());
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      for (int d = 0; d < Dim; ++d)
        points(d, i) = uniform(-1.0, 1.0);
      weights(i) = rational ? uniform(0.5, 2.0) : 1.0;
    }
    return NurbsCurve<Dim>::fromControlPoints(std::move(u), points, weights);
  }

  /** A bumpy height field over a sheared plane: random but without self-intersection.
   */
  NurbsSurface
  surface(int degree_u, int degree_v, bool rational, KnotKind kind)
  {
    KnotVector u = knots(degree_u, kind);
    KnotVector v = knots(degree_v, kind);
    Eigen::Matrix3Xd points(3, u.numControlPoints() * v.numControlPoints());
    Eigen::VectorXd weights(points.cols());
    for (int i = 0; i < u.numControlPoints(); ++i)
      for (int j = 0; j < v.numControlPoints(); ++j) {
        const Eigen::Index column = i * v.numControlPoints() + j;
        points.col(column) << u.greville(i) + 0.1 * v.greville(j), v.greville(j),
            uniform(-0.5, 0.5);
        weights(column) = rational ? uniform(0.5, 2.0) : 1.0;
      }
    return NurbsSurface::fromControlPoints(std::move(u), std::move(v), points, weights);
  }

  double
  inDomain(const KnotVector& knots)
  {
    return uniform(knots.domainMin(), knots.domainMax());
  }

  Eigen::Affine3d
  affine()
  {
    Eigen::Affine3d map = Eigen::Affine3d::Identity();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j)
        map.matrix()(i, j) = uniform(-1.0, 1.0);
    return map;
  }

private:
  std::mt19937_64 engine_;
};

} // namespace test
} // namespace nurbs
} // namespace pcl
