// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs_fitting.h>

#include <pcl/point_types.h>

#include <cmath>
#include <random>

namespace pcl {
namespace nurbs {
namespace test {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Fitting = pcl::NurbsFitting<pcl::PointXYZ>;

/** \brief Points position(u, v, normal noise) for random u and v in [-1, 1]. */
template <typename Position>
Cloud::Ptr
scatteredCloud(Position position, int count, double sigma, unsigned seed)
{
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> normal(0.0, 1.0);
  Cloud::Ptr cloud(new Cloud);
  for (int k = 0; k < count; ++k) {
    const double u = uniform(engine);
    const double v = uniform(engine);
    const Eigen::Vector3d p = position(u, v, sigma * normal(engine));
    cloud->emplace_back(p.x(), p.y(), p.z());
  }
  return cloud;
}

inline Eigen::Vector3d
hill(double u, double v, double noise)
{
  return {u, v, 2.0 + 0.2 * std::cos(2.0 * u) * std::cos(v) + noise};
}

} // namespace test
} // namespace nurbs
} // namespace pcl
