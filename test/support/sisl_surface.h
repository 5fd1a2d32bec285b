// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <sisl.h>

#include <memory>
#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

struct SislDeleter {
  void
  operator()(SISLSurf* surface) const
  {
    freeSurf(surface);
  }
};

using SislSurface = std::unique_ptr<SISLSurf, SislDeleter>;

/** The same surface in SISL, an independent implementation, which stores u fastest
 * where we store v fastest. */
inline SislSurface
toSisl(const NurbsSurface& surface)
{
  const bool rational = surface.isRational();
  const int rows = rational ? 4 : 3;
  std::vector<double> points;
  for (int j = 0; j < surface.numControlPointsV(); ++j)
    for (int i = 0; i < surface.numControlPointsU(); ++i)
      for (int row = 0; row < rows; ++row)
        points.push_back(
            surface.homogeneousPoints()(row, i * surface.numControlPointsV() + j));
  std::vector<double> u = surface.knotsU().values();
  std::vector<double> v = surface.knotsV().values();
  constexpr int kPolynomial = 1;
  constexpr int kRational = 2;
  constexpr int kCopy = 1;
  return SislSurface(newSurf(surface.numControlPointsU(),
                             surface.numControlPointsV(),
                             surface.knotsU().degree() + 1,
                             surface.knotsV().degree() + 1,
                             u.data(),
                             v.data(),
                             points.data(),
                             rational ? kRational : kPolynomial,
                             3,
                             kCopy));
}

} // namespace test
} // namespace nurbs
} // namespace pcl
