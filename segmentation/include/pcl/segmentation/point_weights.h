// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/grid_graph.h>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {

/** \brief exp(-x^2 / (2 sigma^2)). */
inline float
gaussianWeight(float x, float sigma)
{
  return std::exp(-0.5F * x * x / (sigma * sigma));
}

/** \brief Distance and normals: DistanceWeight times a Gaussian of the angle between
 * the normals, either way round. A point without a normal is weighed by its distance
 * alone. For points with normal_x, normal_y, normal_z. Used, as the others here, by
 * EntropyRateSegmentation::setWeightFunction(). */
struct NormalWeight {
  /** Standard deviation of the angle (radians). */
  float sigma = 0.15F;

  template <typename PointT>
  float
  operator()(const PointT& p,
             const PointT& q,
             float squared_distance,
             float variance) const
  {
    const float distance = DistanceWeight()(0, 0, squared_distance, variance);
    const float cosine = std::abs(p.normal_x * q.normal_x + p.normal_y * q.normal_y +
                                  p.normal_z * q.normal_z);
    if (!std::isfinite(cosine))
      return distance;
    return distance * gaussianWeight(std::acos(std::min(cosine, 1.0F)), sigma);
  }
};

/** \brief Distance and intensity: DistanceWeight times a Gaussian of the difference of
 * the intensities. For points with intensity. */
struct IntensityWeight {
  /** Standard deviation, in the unit of the intensities. */
  float sigma = 10.0F;

  template <typename PointT>
  float
  operator()(const PointT& p,
             const PointT& q,
             float squared_distance,
             float variance) const
  {
    return DistanceWeight()(0, 0, squared_distance, variance) *
           gaussianWeight(p.intensity - q.intensity, sigma);
  }
};

/** \brief Distance and colour: DistanceWeight times a Gaussian of the distance of the
 * colours in RGB. For points with r, g, b. */
struct ColorWeight {
  /** Standard deviation, in steps of 0..255. */
  float sigma = 20.0F;

  template <typename PointT>
  float
  operator()(const PointT& p,
             const PointT& q,
             float squared_distance,
             float variance) const
  {
    const auto red = static_cast<float>(p.r - q.r);
    const auto green = static_cast<float>(p.g - q.g);
    const auto blue = static_cast<float>(p.b - q.b);
    const float difference = std::sqrt(red * red + green * green + blue * blue);
    return DistanceWeight()(0, 0, squared_distance, variance) *
           gaussianWeight(difference, sigma);
  }
};

} // namespace nurbs
} // namespace pcl
