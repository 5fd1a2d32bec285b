// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// From a segmentation to patches: a wall stays one patch, its windows are holes in it.

#include <pcl/mapping/surface_reconstruction.h>

#include "surface_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace pcl;
using namespace pcl::nurbs;
using namespace pcl::nurbs::test;

bool
isWindow(int column, int row)
{
  return column % 80 > 25 && column % 80 < 60 && row % 90 > 20 && row % 90 < 70;
}

/** A wall whose windows give no reading, or show a wall farther away. */
Hit
wallWithWindows(int column, int row, bool room)
{
  const Eigen::Vector3d e = ray(column, row);
  if (!isWindow(column, row))
    return {planeDepth({0.3, 0.0, 1.0}, 2.0, e), 1};
  return room ? Hit{planeDepth({0.0, 0.0, 1.0}, 4.0, e), 2} : Hit{std::nan(""), 0};
}

void
expectOnePatchWithHoles(bool room)
{
  const GroupedScene scene = groupScene(
      [room](int column, int row) { return wallWithWindows(column, row, room); });
  const Reconstruction result =
      reconstructSurfaces(scene.points, scene.labels, SensorNoise::kinect());
  const std::uint32_t wall = result.labels[0];
  ASSERT_NE(wall, 0U);
  std::size_t cells = 0;
  std::size_t covered = 0;
  for (std::size_t i = 0; i < scene.truth.size(); ++i)
    if (scene.truth[i] == 1) {
      ++cells;
      covered += result.labels[i] == wall ? 1 : 0;
    }
  EXPECT_GT(static_cast<double>(covered), 0.97 * static_cast<double>(cells));
  const TrimmedSurface& patch = result.model.patches[wall - 1].geometry;
  for (const int column : {42, 122, 202, 282})
    for (const int row : {45, 135}) {
      const Eigen::Vector2d middle(column, row);
      EXPECT_FALSE(patch.contains(middle.x(), middle.y())) << column << ' ' << row;
      EXPECT_TRUE(patch.contains(middle.x() + 40.0 - 80.0 * (column > 240), middle.y()))
          << "beside the window";
    }
}

TEST(WallsWithWindows, windowsWithoutReadingAreHoles)
{
  expectOnePatchWithHoles(false);
}

TEST(WallsWithWindows, windowsToARoomAreHoles)
{
  expectOnePatchWithHoles(true);
}

} // namespace
