// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/batch_evaluation.h>

#include "batch_kernel.h"
#include "regular_point.h"

#include <algorithm>
#include <array>

namespace pcl {
namespace nurbs {
namespace {

PlainSurface::Knots
plain(const KnotVector& knots)
{
  return {knots.values().data(),
          knots.degree(),
          knots.numControlPoints(),
          knots.findSpan(knots.domainMin()),
          knots.findSpan(knots.domainMax())};
}

PlainSurface
plain(const NurbsSurface& surface)
{
  return {plain(surface.knotsU()),
          plain(surface.knotsV()),
          surface.homogeneousPoints().data()};
}

/** Normals from derivatives; where they are parallel the single call decides. */
void
crossToNormals(const NurbsSurface& surface,
               const PlainBatch& jets,
               const CoordinateArrays& normals)
{
  for (std::size_t k = 0; k < jets.n; ++k) {
    const Eigen::Vector3d du(jets.out[3][k], jets.out[4][k], jets.out[5][k]);
    const Eigen::Vector3d dv(jets.out[6][k], jets.out[7][k], jets.out[8][k]);
    Eigen::Vector3d normal = unitNormal(surface, du, dv);
    if (normal.isZero())
      normal = surface.normal(jets.u[k], jets.v[k]);
    normals.x[k] = normal.x();
    normals.y[k] = normal.y();
    normals.z[k] = normal.z();
  }
}

} // namespace

void
evaluateBatch(const NurbsSurface& surface,
              std::size_t n,
              const double* u,
              const double* v,
              const CoordinateArrays& points)
{
  evaluatePlain(plain(surface), {n, u, v, {points.x, points.y, points.z}}, 0);
}

void
evaluateJet1Batch(const NurbsSurface& surface,
                  std::size_t n,
                  const double* u,
                  const double* v,
                  const CoordinateArrays& points,
                  const CoordinateArrays& du,
                  const CoordinateArrays& dv)
{
  evaluatePlain(
      plain(surface),
      {n, u, v, {points.x, points.y, points.z, du.x, du.y, du.z, dv.x, dv.y, dv.z}},
      1);
}

void
evaluateNormalBatch(const NurbsSurface& surface,
                    std::size_t n,
                    const double* u,
                    const double* v,
                    const CoordinateArrays& points,
                    const CoordinateArrays& normals)
{
  constexpr std::size_t kChunk = 64; // derivatives stay in the cache, on the stack
  const PlainSurface arrays = plain(surface);
  std::array<std::array<double, kChunk>, 6> d;
  for (std::size_t first = 0; first < n; first += kChunk) {
    const PlainBatch jets{std::min(kChunk, n - first),
                          u + first,
                          v + first,
                          {points.x + first,
                           points.y + first,
                           points.z + first,
                           d[0].data(),
                           d[1].data(),
                           d[2].data(),
                           d[3].data(),
                           d[4].data(),
                           d[5].data()}};
    evaluatePlain(arrays, jets, 1);
    crossToNormals(
        surface, jets, {normals.x + first, normals.y + first, normals.z + first});
  }
}

} // namespace nurbs
} // namespace pcl
