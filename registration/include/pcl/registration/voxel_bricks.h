// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/nurbs/exports.h>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Which voxels of a sparse grid are there, in bricks of 4 x 4 x 4 with a bit
 * for each: emptiness is seen for 64 voxels at a time.
 * \ingroup registration */
class PCL_NURBS_REGISTRATION_EXPORT VoxelBricks {
public:
  /** Voxels along an edge of a brick. */
  static constexpr int kEdge = 4;

  VoxelBricks();

  void
  clear();

  /** \brief Set a voxel's bit. Amortised O(1) */
  void
  insert(const Eigen::Vector3i& cell);

  /** \brief The brick that a voxel is in. */
  static Eigen::Vector3i
  brickOf(const Eigen::Vector3i& cell);

  /** \brief Bits of a brick, that of the voxel at (x, y, z) within it at
   * x + 4 y + 16 z; 0 when it is empty. O(1) */
  std::uint64_t
  mask(const Eigen::Vector3i& brick) const;

private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint64_t mask = 0; // 0 in a slot that is free
  };

  /** The slot of a key, or the free one where it belongs. */
  std::size_t
  slotOf(std::uint64_t key) const;

  void
  grow();

  std::size_t used_ = 0;
  /** Open addressing, at most half full; the number of slots is a power of two. */
  std::vector<Slot> slots_;
};

} // namespace nurbs
} // namespace pcl
