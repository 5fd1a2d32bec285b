// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/surface_model.h>

#include <gtest/gtest.h>

#include <cstddef>

namespace pcl {
namespace nurbs {
namespace test {

inline void
expectIdentical(const TrimLoop& a, const TrimLoop& b)
{
  ASSERT_EQ(a.curves().size(), b.curves().size());
  for (std::size_t i = 0; i < a.curves().size(); ++i) {
    EXPECT_EQ(a.curves()[i].knots(), b.curves()[i].knots());
    EXPECT_EQ(a.curves()[i].homogeneousPoints(), b.curves()[i].homogeneousPoints());
  }
}

inline void
expectIdentical(const SurfacePatch& a, const SurfacePatch& b)
{
  EXPECT_EQ(a.geometry.surface().knotsU(), b.geometry.surface().knotsU());
  EXPECT_EQ(a.geometry.surface().knotsV(), b.geometry.surface().knotsV());
  EXPECT_EQ(a.geometry.surface().homogeneousPoints(),
            b.geometry.surface().homogeneousPoints());
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.quality.points, b.quality.points);
  EXPECT_EQ(a.quality.noise, b.quality.noise);
  EXPECT_EQ(a.quality.rmse, b.quality.rmse);
  EXPECT_EQ(a.quality.max, b.quality.max);
  ASSERT_EQ(a.geometry.loops().size(), b.geometry.loops().size());
  for (std::size_t i = 0; i < a.geometry.loops().size(); ++i)
    expectIdentical(a.geometry.loops()[i], b.geometry.loops()[i]);
}

/** Every number equal, bit by bit (up to the sign of zero). */
inline void
expectIdentical(const SurfaceModel& a, const SurfaceModel& b)
{
  EXPECT_EQ(a.frame_id, b.frame_id);
  EXPECT_EQ(a.metadata, b.metadata);
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t i = 0; i < a.patches.size(); ++i)
    expectIdentical(a.patches[i], b.patches[i]);
}

} // namespace test
} // namespace nurbs
} // namespace pcl
