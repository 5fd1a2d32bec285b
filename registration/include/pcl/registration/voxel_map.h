// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/registration/nurbs/exports.h>
#include <pcl/registration/voxel_bricks.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Points of one scan, in the sensor's frame, metres. */
using ScanPoints = std::vector<Eigen::Vector3f>;

/** \brief What a VoxelMap keeps.
 * \ingroup registration */
struct VoxelMapOptions {
  /** Edge of a voxel, metres. */
  double voxel_size = 0.5;
  /** Points kept per voxel for nearest(); surface() knows them all. */
  int max_points = 12;
  /** A point nearer than this to a kept one of its voxel is not kept, metres. */
  double min_spacing = 0.1;
};

/** \brief Count, mean and covariance of points. */
struct PointMoments {
  double count = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  /** Population covariance, m^2. */
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/** \brief Sums of points relative to a voxel's centre. */
struct MomentSums {
  double count = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  /** xx xy xz yy yz zz. */
  std::array<double, 6> second{};

  void
  add(const Eigen::Vector3d& point);

  /** \brief Add sums whose origin lies at \a shift from this one's. O(1) */
  void
  add(const MomentSums& other, const Eigen::Vector3d& shift);

  /** \brief Moments about \a origin, which is where the sums count from. */
  PointMoments
  moments(const Eigen::Vector3d& origin) const;
};

/** \brief A map of points in hashed voxels: the local map of an odometry, the target of
 * a registration.
 *
 * Each voxel keeps a bounded number of points, for nearest neighbours, and the sums of
 * all points ever added, so that the local surface (mean and covariance, hence a
 * normal) costs O(1) however many points it is made of. Coordinates are kept relative
 * to the voxel, so precision does not depend on the distance from the origin.
 *
 * Const calls may run in several threads at a time.
 * \ingroup registration */
class PCL_NURBS_REGISTRATION_EXPORT VoxelMap {
public:
  /** \throws std::invalid_argument when an option makes no sense */
  explicit VoxelMap(const VoxelMapOptions& options = {});

  /** \brief Add a point. Points that are not finite or farther than a million voxels
   * from the origin are refused. Amortised O(max_points)
   * \return whether it was added */
  bool
  insert(const Eigen::Vector3d& point);

  /** \brief Forget the voxels whose centre is farther than a radius. O(voxels) */
  void
  removeFarFrom(const Eigen::Vector3d& center, double radius);

  void
  clear();

  /** \brief A map of the same points in voxels, and with spacings, of twice the size.
   * Moments are of all points ever added; kept are some of the kept ones. O(voxels) */
  VoxelMap
  coarsened() const;

  /** \brief The kept point nearest to a place, not farther than \a max_distance:
   * exactly so, however many voxels lie in between. O(max_points) where there is one
   * nearby, O((max_distance / voxel_size / 4)^3) where there is none */
  std::optional<Eigen::Vector3d>
  nearest(const Eigen::Vector3d& place, double max_distance) const;

  /** \brief Moments of all points in the block of 2 x 2 x 2 voxels whose centre is
   * nearest to a place; count 0 where there are none. O(1) */
  PointMoments
  surface(const Eigen::Vector3d& place) const;

  /** \brief All kept points, in the order in which voxels were made. */
  std::vector<Eigen::Vector3d>
  points() const;

  const VoxelMapOptions&
  options() const
  {
    return options_;
  }

  std::size_t
  voxelCount() const
  {
    return voxels_.size();
  }

  bool
  empty() const
  {
    return voxels_.empty();
  }

private:
  using Cell = Eigen::Vector3i;

  struct Voxel {
    Cell cell = Cell::Zero();
    int count = 0;
    MomentSums sums;
  };

  struct Slot {
    std::uint64_t key = 0;
    std::int32_t voxel = -1;
  };

  /** The best point so far, relative to the asked place. */
  struct Candidate {
    float square;
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
    bool found = false;
  };

  Eigen::Vector3d
  center(const Cell& cell) const;

  /** Where the points of a voxel begin. */
  std::size_t
  firstPoint(std::int32_t voxel) const;

  std::int32_t
  find(const Cell& cell) const;

  std::int32_t
  findOrAdd(const Cell& cell);

  void
  rebuildTable(std::size_t slots);

  void
  keep(std::int32_t voxel, const Eigen::Vector3f& local);

  void
  scanVoxel(std::int32_t voxel, const Eigen::Vector3d& place, Candidate& best) const;

  void
  scanShell(const Cell& middle,
            int ring,
            const Eigen::Vector3d& place,
            Candidate& best) const;

  /** All voxels of a brick that may hold something better. */
  void
  scanBrick(const Cell& brick, const Eigen::Vector3d& place, Candidate& best) const;

  /** All voxels nearer than the best so far, brick by brick. */
  void
  scanBricks(const Eigen::Vector3d& place, Candidate& best) const;

  VoxelMapOptions options_;
  double inverse_size_ = 1.0;
  std::vector<Voxel> voxels_;
  /** max_points of each voxel, relative to its centre. */
  std::vector<Eigen::Vector3f> points_;
  /** Open addressing, at most half full; the number of slots is a power of two. */
  std::vector<Slot> table_;
  VoxelBricks bricks_;
};

} // namespace nurbs
} // namespace pcl
