// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// Masks of rasters whose samples lie apart, and the sheet most points are near to.

#include "mask_operations.h"
#include "robust_plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using namespace pcl;
using namespace pcl::nurbs;

CellMask
emptyMask(int width, int height)
{
  CellMask mask;
  mask.width = width;
  mask.height = height;
  mask.cells.assign(static_cast<std::size_t>(width * height), 0);
  return mask;
}

/** Cells of a square window that a share of random samples covers. */
CellMask
randomMask(unsigned seed, double share)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  CellMask mask = emptyMask(23, 17);
  for (char& cell : mask.cells)
    cell = uniform(random) < share ? 1 : 0;
  return mask;
}

/** Whether some square of 2 r + 1 cells that holds the cell has no set cell. */
bool
inEmptySquare(const CellMask& mask, int column, int row, int r)
{
  for (int y = row - r; y <= row + r; ++y)
    for (int x = column - r; x <= column + r; ++x) {
      bool any = false;
      for (int dy = -r; dy <= r; ++dy)
        for (int dx = -r; dx <= r; ++dx)
          any = any || mask.at(x + dx, y + dy);
      if (!any)
        return true;
    }
  return false;
}

TEST(MaskOperations, ClosingIsThatOfSquares)
{
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const CellMask mask = randomMask(seed, 0.08);
    for (const int gap : {2, 3, 4, 6}) {
      const CellMask result = closed(mask, gap);
      for (int row = 0; row < mask.height; ++row)
        for (int column = 0; column < mask.width; ++column) {
          if (!inEmptySquare(mask, column, row, gap / 2)) {
            EXPECT_TRUE(result.at(column, row)) << seed << ' ' << gap;
          }
          if (mask.at(column, row)) {
            EXPECT_TRUE(result.at(column, row)) << seed << ' ' << gap;
          }
        }
      // Pinholes are all that is closed besides.
      CellMask squares = emptyMask(mask.width, mask.height);
      for (int row = 0; row < mask.height; ++row)
        for (int column = 0; column < mask.width; ++column)
          squares.cells[static_cast<std::size_t>(row * mask.width + column)] =
              inEmptySquare(mask, column, row, gap / 2) ? 0 : 1;
      EXPECT_EQ(result.cells, closed(squares, 1).cells) << seed << ' ' << gap;
    }
  }
}

TEST(MaskOperations, SparseSheetClosesToOnePart)
{
  CellMask samples = emptyMask(61, 41);
  for (int row = 0; row < samples.height; row += 4)
    for (int column = 0; column < samples.width; column += 4)
      samples.cells[static_cast<std::size_t>(row * samples.width + column)] = 1;
  CellMask dense = closed(samples, 4);
  EXPECT_EQ(std::count(dense.cells.begin(), dense.cells.end(), 1), 61 * 41);
  clearSmallParts(dense, samples, 16 * 11);
  EXPECT_EQ(std::count(dense.cells.begin(), dense.cells.end(), 1), 61 * 41);
  clearSmallParts(dense, samples, 16 * 11 + 1);
  EXPECT_EQ(std::count(dense.cells.begin(), dense.cells.end(), 1), 0);
}

TEST(MaskOperations, PartsReachOverGapsAndSeam)
{
  GridGeometry grid;
  grid.width = 20;
  grid.height = 3;
  const std::vector<std::int32_t> cells = {0, 3, 10, 18, 20 + 10, 40 + 11};
  std::vector<char> scratch;
  EXPECT_EQ(connectedParts(grid, cells, scratch).size(), 5U);
  grid.max_gap = 3;
  EXPECT_EQ(connectedParts(grid, cells, scratch),
            (std::vector<std::vector<std::int32_t>>{{0, 3}, {10, 30, 51}, {18}}));
  grid.wrap = true;
  EXPECT_EQ(connectedParts(grid, cells, scratch),
            (std::vector<std::vector<std::int32_t>>{{0, 3, 18}, {10, 30, 51}}));
}

TEST(RobustSlab, FindsTheSheetAmongOthers)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-10.0, 10.0);
  std::normal_distribution<double> noise(0.0, 0.02);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.1, -0.2, 1.0).normalized();
  Eigen::Matrix3Xd points(3, 5000);
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    Eigen::Vector3d point(uniform(random), uniform(random), uniform(random));
    if (k % 5 < 2) // two fifths on the sheet, the rest anywhere
      point += normal * (1.5 + noise(random) - normal.dot(point));
    points.col(k) = point;
  }
  const Slab slab = robustSlab(points, 0.1);
  EXPECT_GT(std::abs(slab.middle.normal().dot(normal)), std::cos(0.01));
  EXPECT_LT(slab.middle.absDistance(1.5 * normal), 0.02);
  EXPECT_TRUE(slab.contains(1.5 * normal));
  EXPECT_FALSE(slab.contains(1.75 * normal));
  EXPECT_EQ(slab.middle.coeffs(), robustSlab(points, 0.1).middle.coeffs());
}

TEST(RobustSlab, TakesDegeneratePoints)
{
  EXPECT_TRUE(
      robustSlab(Eigen::Matrix3Xd::Zero(3, 5), 0.1).contains(Eigen::Vector3d::Zero()));
  Eigen::Matrix3Xd line = Eigen::Matrix3Xd::Zero(3, 50);
  line.row(0).setLinSpaced(0.0, 49.0);
  const Slab slab = robustSlab(line, 0.1);
  EXPECT_TRUE(slab.middle.coeffs().allFinite());
  EXPECT_TRUE(slab.contains(line.col(49)));
}

} // namespace
