// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/registration/voxel_map.h>

#include "voxel_key.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kFirstSlots = 1024;

void
check(const VoxelMapOptions& options)
{
  if (!std::isfinite(options.voxel_size) || options.voxel_size <= 0.0)
    throw std::invalid_argument("VoxelMap: the voxel size must be positive");
  if (options.max_points < 1 || options.max_points > 1000)
    throw std::invalid_argument("VoxelMap: between 1 and 1000 points per voxel");
  if (!(options.min_spacing >= 0.0))
    throw std::invalid_argument("VoxelMap: the spacing must not be negative");
}

/** Square of the distance from a place to a cube, relative to whose centre it is. */
double
squareToCube(const Eigen::Vector3d& local, double edge)
{
  const Eigen::Array3d outside = local.array().abs() - 0.5 * edge;
  return outside.max(0.0).square().sum();
}

} // namespace

VoxelMap::VoxelMap(const VoxelMapOptions& options) : options_(options)
{
  check(options);
  inverse_size_ = 1.0 / options.voxel_size;
  rebuildTable(kFirstSlots);
}

Eigen::Vector3d
VoxelMap::center(const Cell& cell) const
{
  return (cell.cast<double>().array() + 0.5) * options_.voxel_size;
}

std::size_t
VoxelMap::firstPoint(std::int32_t voxel) const
{
  return static_cast<std::size_t>(voxel) *
         static_cast<std::size_t>(options_.max_points);
}

std::int32_t
VoxelMap::find(const Cell& cell) const
{
  const std::uint64_t key = voxelKey(cell);
  const std::size_t mask = table_.size() - 1;
  for (std::size_t i = voxelHash(key) & mask; table_[i].voxel >= 0; i = (i + 1) & mask)
    if (table_[i].key == key)
      return table_[i].voxel;
  return -1;
}

std::int32_t
VoxelMap::findOrAdd(const Cell& cell)
{
  const std::int32_t known = find(cell);
  if (known >= 0)
    return known;
  voxels_.emplace_back();
  voxels_.back().cell = cell;
  bricks_.insert(cell);
  points_.resize(points_.size() + static_cast<std::size_t>(options_.max_points));
  if (2 * voxels_.size() > table_.size())
    rebuildTable(2 * table_.size());
  else
    addToTable(table_, voxelKey(cell), static_cast<std::int32_t>(voxels_.size() - 1));
  return static_cast<std::int32_t>(voxels_.size() - 1);
}

void
VoxelMap::rebuildTable(std::size_t slots)
{
  table_.assign(slots, Slot());
  for (std::size_t i = 0; i < voxels_.size(); ++i)
    addToTable(table_, voxelKey(voxels_[i].cell), static_cast<std::int32_t>(i));
}

void
VoxelMap::keep(std::int32_t voxel, const Eigen::Vector3f& local)
{
  Voxel& target = voxels_[static_cast<std::size_t>(voxel)];
  if (target.count == options_.max_points)
    return;
  Eigen::Vector3f* const kept = &points_[firstPoint(voxel)];
  const auto spacing = static_cast<float>(options_.min_spacing);
  const bool close = std::any_of(kept, kept + target.count, [&](const auto& other) {
    return (other - local).squaredNorm() < spacing * spacing;
  });
  if (!close)
    kept[target.count++] = local;
}

bool
VoxelMap::insert(const Eigen::Vector3d& point)
{
  const auto cell = voxelCell(point, inverse_size_);
  if (!cell)
    return false;
  const std::int32_t voxel = findOrAdd(*cell);
  const Eigen::Vector3d local = point - center(*cell);
  voxels_[static_cast<std::size_t>(voxel)].sums.add(local);
  keep(voxel, local.cast<float>());
  return true;
}

void
VoxelMap::removeFarFrom(const Eigen::Vector3d& place, double radius)
{
  const auto stride = static_cast<std::size_t>(options_.max_points);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < voxels_.size(); ++i) {
    if ((center(voxels_[i].cell) - place).squaredNorm() > radius * radius)
      continue;
    if (kept != i) {
      voxels_[kept] = voxels_[i];
      std::copy_n(&points_[i * stride], stride, &points_[kept * stride]);
    }
    ++kept;
  }
  voxels_.resize(kept);
  points_.resize(kept * stride);
  rebuildTable(table_.size());
  bricks_.clear();
  for (const Voxel& voxel : voxels_)
    bricks_.insert(voxel.cell);
}

void
VoxelMap::clear()
{
  voxels_.clear();
  points_.clear();
  bricks_.clear();
  rebuildTable(kFirstSlots);
}

void
VoxelMap::scanVoxel(std::int32_t voxel,
                    const Eigen::Vector3d& place,
                    Candidate& best) const
{
  const Voxel& asked = voxels_[static_cast<std::size_t>(voxel)];
  const Eigen::Vector3f local = (place - center(asked.cell)).cast<float>();
  const Eigen::Vector3f* const first = &points_[firstPoint(voxel)];
  for (const Eigen::Vector3f* p = first; p != first + asked.count; ++p) {
    const Eigen::Vector3f offset = *p - local;
    const float square = offset.squaredNorm();
    if (square < best.square)
      best = {square, offset, true};
  }
}

void
VoxelMap::scanShell(const Cell& middle,
                    int ring,
                    const Eigen::Vector3d& place,
                    Candidate& best) const
{
  const Eigen::Vector3d local = place - center(middle);
  for (int x = -ring; x <= ring; ++x)
    for (int y = -ring; y <= ring; ++y) {
      const bool side = std::abs(x) == ring || std::abs(y) == ring;
      for (int z = -ring; z <= ring; z += side || ring == 0 ? 1 : 2 * ring) {
        const Cell offset(x, y, z);
        const double size = options_.voxel_size;
        if (squareToCube(local - size * offset.cast<double>(), size) >= best.square)
          continue;
        const std::int32_t voxel = find(middle + offset);
        if (voxel >= 0)
          scanVoxel(voxel, place, best);
      }
    }
}

void
VoxelMap::scanBrick(const Cell& brick,
                    const Eigen::Vector3d& place,
                    Candidate& best) const
{
  constexpr int kEdge = VoxelBricks::kEdge;
  const double size = options_.voxel_size;
  std::uint64_t mask = bricks_.mask(brick);
  for (int i = 0; mask != 0; ++i, mask >>= 1U) {
    if ((mask & 1U) == 0)
      continue;
    const Cell cell =
        kEdge * brick + Cell(i % kEdge, i / kEdge % kEdge, i / (kEdge * kEdge));
    if (squareToCube(place - center(cell), size) < best.square)
      scanVoxel(find(cell), place, best);
  }
}

void
VoxelMap::scanBricks(const Eigen::Vector3d& place, Candidate& best) const
{
  const double edge = VoxelBricks::kEdge * options_.voxel_size;
  const auto brick_at = [&](const Eigen::Array3d& where) -> Cell {
    return (where / edge).floor().cast<int>();
  };
  // What the brick of the place itself holds leaves little to look for in others.
  const Cell own = brick_at(place);
  scanBrick(own, place, best);
  const Eigen::Array3d reach =
      Eigen::Array3d::Constant(std::sqrt(static_cast<double>(best.square)));
  const Cell first = brick_at(place.array() - reach);
  const Cell last = brick_at(place.array() + reach);
  for (int x = first.x(); x <= last.x(); ++x)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int z = first.z(); z <= last.z(); ++z) {
        const Cell brick(x, y, z);
        const Eigen::Vector3d middle = edge * (brick.cast<double>().array() + 0.5);
        if (brick != own && squareToCube(place - middle, edge) < best.square)
          scanBrick(brick, place, best);
      }
}

std::optional<Eigen::Vector3d>
VoxelMap::nearest(const Eigen::Vector3d& place, double max_distance) const
{
  const auto cell = voxelCell(place, inverse_size_);
  if (!cell || !(max_distance > 0.0) || voxels_.empty())
    return std::nullopt;
  max_distance = std::min(max_distance, 2.0 * kMaxCell * options_.voxel_size);
  Candidate best{static_cast<float>(max_distance * max_distance)};
  const Eigen::Array3d local = (place - center(*cell)).array();
  const double margin = 0.5 * options_.voxel_size - local.abs().maxCoeff();
  scanShell(*cell, 0, place, best);
  if (margin * margin < best.square)
    scanShell(*cell, 1, place, best);
  const double reach = margin + options_.voxel_size;
  if (reach * reach < best.square)
    scanBricks(place, best);
  if (!best.found)
    return std::nullopt;
  return place + best.offset.cast<double>();
}

std::vector<Eigen::Vector3d>
VoxelMap::points() const
{
  std::vector<Eigen::Vector3d> all;
  const auto stride = static_cast<std::size_t>(options_.max_points);
  for (std::size_t i = 0; i < voxels_.size(); ++i)
    for (int k = 0; k < voxels_[i].count; ++k)
      all.emplace_back(
          center(voxels_[i].cell) +
          points_[i * stride + static_cast<std::size_t>(k)].cast<double>());
  return all;
}

} // namespace nurbs
} // namespace pcl
