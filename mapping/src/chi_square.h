// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <boost/math/distributions/chi_squared.hpp>

namespace pcl {
namespace nurbs {

/** x of which a chi square variable is less with this probability. */
inline double
chiSquareQuantile(int freedom, double probability)
{
  return boost::math::quantile(boost::math::chi_squared(freedom), probability);
}

} // namespace nurbs
} // namespace pcl
