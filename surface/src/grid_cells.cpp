// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "grid_cells.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

double
leastStep(const std::vector<double>& lines)
{
  double least = HUGE_VAL;
  for (std::size_t i = 1; i < lines.size(); ++i)
    least = std::min(least, lines[i] - lines[i - 1]);
  return least;
}

} // namespace

bool
isGridPoint(const Eigen::Vector2d& cell)
{
  return cell.x() == std::floor(cell.x()) && cell.y() == std::floor(cell.y());
}

GridCells::GridCells(const SurfaceGrid& grid, const std::vector<BorderLoop>& loops)
    : grid_(grid),
      cells_(static_cast<std::size_t>(grid.cellsU()) *
                 static_cast<std::size_t>(grid.cellsV()),
             Cell::Outside),
      origin_(grid.u().front(), grid.v().front())
{
  chooseScale();
  for (const BorderLoop& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k)
      markSegment(grid.cellCoordinates(loop[k].parameter),
                  grid.cellCoordinates(loop[(k + 1) % loop.size()].parameter));
  indexBorder(loops);
  for (int i = 0; i < grid.cellsU(); ++i)
    for (int j = 0; j < grid.cellsV(); ++j) {
      Cell& cell = cells_[index(i, j)];
      const Eigen::Vector2d middle = 0.5 * (point(i, j) + point(i + 1, j + 1));
      if (cell == Cell::Outside && inside_->contains(scaled(middle)))
        cell = Cell::Full;
    }
}

bool
GridCells::areAllWhole() const
{
  return std::find(cells_.begin(), cells_.end(), Cell::Border) == cells_.end();
}

void
GridCells::chooseScale()
{
  constexpr double kMaxAspect = 4096.0; // beyond, the lattice would be too coarse
  const Eigen::Vector2d extent =
      Eigen::Vector2d(grid_.u().back(), grid_.v().back()) - origin_;
  Eigen::Vector2d lengths = extent.cwiseProduct(grid_.scale());
  lengths = lengths.cwiseMax(lengths.maxCoeff() / kMaxAspect);
  if (!(lengths.maxCoeff() > 0.0))
    lengths.setOnes();
  scale_ = lengths.cwiseQuotient(extent) / lengths.maxCoeff();
}

void
GridCells::markSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  if (isGridPoint(a) && isGridPoint(b) && (a - b).lpNorm<1>() == 1.0)
    return; // a side of a cell
  // Segments are not longer than a cell, so their box is close to them. The margin
  // keeps cells clear of edges by more than a lattice step.
  constexpr double kMargin = 1e-3;
  const Eigen::Vector2d low = a.cwiseMin(b).array() - kMargin;
  const Eigen::Vector2d high = a.cwiseMax(b).array() + kMargin;
  const auto bounded = [](double cell, int count) {
    return std::clamp(static_cast<int>(std::floor(cell)), 0, count - 1);
  };
  const int last_i = bounded(high.x(), grid_.cellsU());
  const int last_j = bounded(high.y(), grid_.cellsV());
  for (int i = bounded(low.x(), grid_.cellsU()); i <= last_i; ++i)
    for (int j = bounded(low.y(), grid_.cellsV()); j <= last_j; ++j)
      cells_[index(i, j)] = Cell::Border;
}

void
GridCells::indexBorder(const std::vector<BorderLoop>& loops)
{
  constexpr double kClearance = 0.1; // of the smallest cell
  std::vector<std::vector<Eigen::Vector2d>> polygons;
  for (const BorderLoop& loop : loops) {
    polygons.emplace_back();
    for (const BorderSample& sample : loop)
      polygons.back().push_back(scaled(sample.parameter));
  }
  const double least =
      std::min(leastStep(grid_.u()) * scale_.x(), leastStep(grid_.v()) * scale_.y());
  inside_.emplace(polygons, kClearance * least);
}

} // namespace nurbs
} // namespace pcl
