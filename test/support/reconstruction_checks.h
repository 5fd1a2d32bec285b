// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/surface_reconstruction.h>
#include <pcl/surface/nurbs/closest_point.h>

#include <gtest/gtest.h>

#include <vector>

namespace pcl {
namespace nurbs {
namespace test {

inline void
expectSameSurface(const SurfacePatch& a, const SurfacePatch& b)
{
  const NurbsSurface& s = a.geometry.surface();
  const NurbsSurface& t = b.geometry.surface();
  ASSERT_EQ(s.knotsU().values(), t.knotsU().values());
  ASSERT_EQ(s.knotsV().values(), t.knotsV().values());
  EXPECT_EQ(s.homogeneousPoints(), t.homogeneousPoints());
}

/** Equal to the last bit: surfaces, trims, labels and distances. */
inline void
expectIdentical(const Reconstruction& a, const Reconstruction& b)
{
  EXPECT_EQ(a.labels, b.labels);
  ASSERT_EQ(a.model.patches.size(), b.model.patches.size());
  for (std::size_t k = 0; k < a.model.patches.size(); ++k) {
    const SurfacePatch& p = a.model.patches[k];
    const SurfacePatch& q = b.model.patches[k];
    expectSameSurface(p, q);
    EXPECT_EQ(p.label, q.label);
    ASSERT_EQ(p.geometry.loops().size(), q.geometry.loops().size());
    for (std::size_t i = 0; i < p.geometry.loops().size(); ++i)
      EXPECT_EQ(p.geometry.loops()[i].curves()[0].homogeneousPoints(),
                q.geometry.loops()[i].curves()[0].homogeneousPoints());
  }
  for (std::size_t cell = 0; cell < a.labels.size(); ++cell)
    if (a.labels[cell] != 0) {
      ASSERT_EQ(a.distances[cell], b.distances[cell]);
    }
}

/** Cells of each patch, by its number. */
inline std::vector<std::vector<std::size_t>>
cellsOfPatches(const Reconstruction& reconstruction)
{
  std::vector<std::vector<std::size_t>> result(reconstruction.model.patches.size());
  for (std::size_t cell = 0; cell < reconstruction.labels.size(); ++cell)
    if (reconstruction.labels[cell] != 0)
      result.at(reconstruction.labels[cell] - 1).push_back(cell);
  return result;
}

/** How the patches hold their own points, found by global search. */
struct OwnPoints {
  double inside = 0.0;   /**< share whose foot point the trims contain */
  double agreeing = 0.0; /**< share whose reported distance is the least one */
};

/** \param[in] every look at every so-manieth point of a patch only */
inline OwnPoints
checkOwnPoints(const GridPoints& points,
               const Reconstruction& reconstruction,
               std::size_t every)
{
  OwnPoints result;
  double looked = 0.0;
  const auto cells = cellsOfPatches(reconstruction);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const TrimmedSurface& geometry = reconstruction.model.patches[k].geometry;
    const ClosestPointFinder finder(geometry.surface());
    for (std::size_t i = 0; i < cells[k].size(); i += every) {
      const std::size_t cell = cells[k][i];
      const ClosestPoint foot = finder.find(points.point(cell).cast<double>());
      const double reported = std::abs(reconstruction.distances[cell]);
      looked += 1.0;
      result.inside += geometry.contains(foot.u, foot.v) ? 1.0 : 0.0;
      result.agreeing += std::abs(foot.distance - reported) < 1e-4 ? 1.0 : 0.0;
    }
  }
  result.inside /= looked;
  result.agreeing /= looked;
  return result;
}

} // namespace test
} // namespace nurbs
} // namespace pcl
