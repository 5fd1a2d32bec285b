// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Borders of masks: they wind around exactly the cells of the mask.

#include "mask_boundary.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>
#include <string>
#include <tuple>

namespace {

using namespace pcl::nurbs;

CellMask
maskOf(const std::vector<std::string>& rows)
{
  CellMask mask;
  mask.height = static_cast<int>(rows.size());
  mask.width = static_cast<int>(rows.front().size());
  for (const std::string& row : rows)
    for (const char cell : row)
      mask.cells.push_back(cell == '#' ? 1 : 0);
  return mask;
}

CellMask
randomMask(std::mt19937& random, int width, int height, double share)
{
  std::bernoulli_distribution filled(share);
  CellMask mask;
  mask.width = width;
  mask.height = height;
  for (int k = 0; k < width * height; ++k)
    mask.cells.push_back(filled(random) ? 1 : 0);
  return mask;
}

Eigen::Vector2i
edge(const LatticeLoop& loop, std::size_t k)
{
  return loop[(k + 1) % loop.size()] - loop[k];
}

/** How often a loop runs around the centre of a cell: crossings of the ray to the
 * right.
 */
int
winding(const LatticeLoop& loop, int column, int row)
{
  int result = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Eigen::Vector2i from = loop[k];
    const Eigen::Vector2i to = loop[(k + 1) % loop.size()];
    if (from.x() != to.x() || from.x() <= column)
      continue;
    if (from.y() <= row && to.y() > row)
      ++result;
    if (to.y() <= row && from.y() > row)
      --result;
  }
  return result;
}

int
doubledArea(const LatticeLoop& loop)
{
  int sum = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Eigen::Vector2i& a = loop[k];
    const Eigen::Vector2i& b = loop[(k + 1) % loop.size()];
    sum += a.x() * b.y() - b.x() * a.y();
  }
  return sum;
}

/** Unit edges between a cell of the mask and another one, counted cell by cell. */
int
countBorderEdges(const CellMask& mask)
{
  int count = 0;
  for (int row = 0; row < mask.height; ++row)
    for (int column = 0; column < mask.width; ++column)
      if (mask.at(column, row))
        for (const auto& [dc, dr] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
          count += mask.at(column + dc, row + dr) ? 0 : 1;
  return count;
}

void
expectLaws(const CellMask& mask)
{
  const std::vector<LatticeLoop> loops = traceBoundary(mask);
  int length = 0;
  for (const LatticeLoop& loop : loops) {
    ASSERT_GE(loop.size(), 4U);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Eigen::Vector2i step = edge(loop, k);
      const Eigen::Vector2i next = edge(loop, (k + 1) % loop.size());
      ASSERT_TRUE((step.x() == 0) != (step.y() == 0)) << "edges follow the lattice";
      ASSERT_EQ(step.dot(next), 0) << "straight runs are one edge";
      length += std::abs(step.x()) + std::abs(step.y());
    }
  }
  EXPECT_EQ(length, countBorderEdges(mask));
  for (int row = 0; row < mask.height; ++row)
    for (int column = 0; column < mask.width; ++column) {
      int sum = 0;
      for (const LatticeLoop& loop : loops)
        sum += winding(loop, column, row);
      ASSERT_EQ(sum, mask.at(column, row) ? 1 : 0) << column << ' ' << row;
    }
}

TEST(MaskBoundary, emptyMaskHasNone)
{
  EXPECT_TRUE(traceBoundary(maskOf({"...", "..."})).empty());
  EXPECT_TRUE(traceBoundary(CellMask()).empty());
}

TEST(MaskBoundary, oneCellIsASquareCounterClockwise)
{
  const auto loops = traceBoundary(maskOf({"...", ".#.", "..."}));
  ASSERT_EQ(loops.size(), 1U);
  const LatticeLoop expected{{1, 1}, {2, 1}, {2, 2}, {1, 2}};
  EXPECT_EQ(loops.front(), expected);
  EXPECT_EQ(doubledArea(loops.front()), 2);
}

TEST(MaskBoundary, holesRunTheOtherWay)
{
  const auto loops =
      traceBoundary(maskOf({"#####", "#...#", "#.#.#", "#...#", "#####"}));
  ASSERT_EQ(loops.size(), 3U);
  std::multiset<int> areas;
  for (const LatticeLoop& loop : loops)
    areas.insert(doubledArea(loop));
  EXPECT_EQ(areas, (std::multiset<int>{-18, 2, 50}));
}

TEST(MaskBoundary, cellsThatTouchInACornerAreApart)
{
  const auto loops = traceBoundary(maskOf({"#.#", ".#.", "#.#"}));
  ASSERT_EQ(loops.size(), 5U);
  for (const LatticeLoop& loop : loops)
    EXPECT_EQ(doubledArea(loop), 2);
}

TEST(MaskBoundary, windsAroundTheCellsOfRandomMasks)
{
  std::mt19937 random(7);
  for (int n = 0; n < 300; ++n) {
    SCOPED_TRACE(n);
    const int width = 1 + n % 17;
    const int height = 1 + n % 13;
    expectLaws(randomMask(random, width, height, 0.1 + 0.8 * (n % 9) / 8.0));
  }
}

} // namespace
