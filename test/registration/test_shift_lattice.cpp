// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

//
// The best shift of a scan in an occupancy grid against trying them one by one.

#include "shift_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <utility>

namespace {

using namespace pcl::nurbs;

constexpr double kCell = 0.5;
const Eigen::Vector3d kCenter(3.0, -2.0, 1.0);

ScanPoints
randomPoints(std::size_t count, float reach, std::mt19937& random)
{
  std::uniform_real_distribution<float> place(-reach, reach);
  ScanPoints points;
  for (std::size_t i = 0; i < count; ++i)
    points.emplace_back(place(random), place(random), 0.3F * place(random));
  return points;
}

OccupancyGrid
randomGrid(std::mt19937& random)
{
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3f& point : randomPoints(3000, 14.0F, random))
    points.emplace_back(kCenter + point.cast<double>());
  return OccupancyGrid(points, kCenter, kCell);
}

/** A pose at the grid's center and some cells away. */
Eigen::Isometry3d
at(const Eigen::Vector3d& cells)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = kCenter + kCell * cells;
  return pose;
}

/** The best fit of all shifts, one by one. */
int
bestByTrying(const OccupancyGrid& grid, const ScanPoints& scan, int most, int step)
{
  int best = -1;
  for (int x = -most; x <= most; x += step)
    for (int y = -most; y <= most; y += step)
      for (int z = -most; z <= most; z += step)
        best = std::max(best, grid.fit(scan, at(Eigen::Vector3d(x, y, z))));
  return best;
}

TEST(ShiftLattice, FindsWhatTryingFinds)
{
  std::mt19937 random(1);
  const OccupancyGrid grid = randomGrid(random);
  const ScanPoints scan = randomPoints(200, 12.0F, random); // none leaves the grid
  for (const auto& [most, step] : {std::pair(0, 1), {0, 3}, {3, 1}, {8, 2}, {6, 3}}) {
    const ShiftFit found =
        ShiftLattice(grid, most, step).best(grid.placed(scan, at({0, 0, 0})));
    EXPECT_EQ(found.fit, bestByTrying(grid, scan, most, step)) << most << ' ' << step;
    EXPECT_EQ(found.fit, grid.fit(scan, at(found.shift.cast<double>())));
    EXPECT_LE(found.shift.cwiseAbs().maxCoeff(), most);
  }
}

TEST(ShiftLattice, UndoesAShift)
{
  std::mt19937 random(2);
  const ScanPoints scan = randomPoints(100, 10.0F, random);
  std::vector<Eigen::Vector3d> there;
  for (const Eigen::Vector3f& point : scan)
    there.emplace_back(at({4, -6, 2}) * point.cast<double>());
  const OccupancyGrid grid(there, kCenter, kCell);
  const ShiftFit found =
      ShiftLattice(grid, 8, 2).best(grid.placed(scan, at({0, 0, 0})));
  EXPECT_EQ(found.shift, Eigen::Vector3f(4, -6, 2));
  EXPECT_EQ(found.fit, OccupancyGrid::kLevels * 100);
}

TEST(ShiftLattice, PointsOutsideCountNothing)
{
  std::mt19937 random(3);
  const OccupancyGrid grid = randomGrid(random);
  const ShiftLattice lattice(grid, 8, 2);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(lattice.best({}).fit, 0);
  EXPECT_EQ(lattice.best({{-1, 5, 5}, {5, 64, 5}, {5, 5, 1e9F}, {nan, 5, 5}}).fit, 0);
}

TEST(ShiftLattice, RefusesOtherLattices)
{
  std::mt19937 random(4);
  const OccupancyGrid grid = randomGrid(random);
  EXPECT_THROW(ShiftLattice(grid, 4, 0), std::invalid_argument);
  EXPECT_THROW(ShiftLattice(grid, -2, 1), std::invalid_argument);
  EXPECT_THROW(ShiftLattice(grid, 5, 2), std::invalid_argument);
  EXPECT_THROW(ShiftLattice(grid, 8, 1), std::invalid_argument); // 17 along an axis
}

} // namespace
