// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/registration/voxel_bricks.h>

#include "voxel_key.h"

#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::size_t kFirstSlots = 256;
constexpr int kShift = 2; // 2^2 = kEdge

} // namespace

VoxelBricks::VoxelBricks() : slots_(kFirstSlots)
{
}

void
VoxelBricks::clear()
{
  used_ = 0;
  slots_.assign(kFirstSlots, Slot());
}

Eigen::Vector3i
VoxelBricks::brickOf(const Eigen::Vector3i& cell)
{
  return {cell.x() >> kShift, cell.y() >> kShift, cell.z() >> kShift};
}

std::size_t
VoxelBricks::slotOf(std::uint64_t key) const
{
  const std::size_t last = slots_.size() - 1;
  std::size_t i = voxelHash(key) & last;
  while (slots_[i].mask != 0 && slots_[i].key != key)
    i = (i + 1) & last;
  return i;
}

void
VoxelBricks::grow()
{
  std::vector<Slot> old(2 * slots_.size());
  std::swap(old, slots_);
  for (const Slot& slot : old)
    if (slot.mask != 0)
      slots_[slotOf(slot.key)] = slot;
}

void
VoxelBricks::insert(const Eigen::Vector3i& cell)
{
  const Eigen::Vector3i brick = brickOf(cell);
  const Eigen::Vector3i within = cell - kEdge * brick;
  const std::uint64_t key = voxelKey(brick);
  Slot* slot = &slots_[slotOf(key)];
  if (slot->mask == 0 && 2 * ++used_ > slots_.size()) {
    grow();
    slot = &slots_[slotOf(key)];
  }
  slot->key = key;
  slot->mask |= std::uint64_t{1}
                << (within.x() + kEdge * (within.y() + kEdge * within.z()));
}

std::uint64_t
VoxelBricks::mask(const Eigen::Vector3i& brick) const
{
  return slots_[slotOf(voxelKey(brick))].mask;
}

} // namespace nurbs
} // namespace pcl
