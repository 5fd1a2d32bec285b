// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/trajectory.h>

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace pcl {
namespace nurbs {

/** Lanes and edges of a road, metres from the driven path, left positive. */
struct RoadShape {
  static constexpr double kMiddle = 1.0;
  static constexpr double kHalfWidth = 4.9;
  static constexpr double kSidewalk = 1.8;
  static constexpr double kOncoming = 2.7;
  static constexpr double kParking = 3.95; // from the middle
};

/** The line on the ground below a drive, as nodes at equal steps, with an end piece at
 * both ends so that the town goes on; and which of it is road of its own. */
class TownPath {
public:
  struct Node {
    Eigen::Vector3d ground = Eigen::Vector3d::Zero();
    Eigen::Vector2d along = Eigen::Vector2d::UnitX();
    double arc = 0.0;
    bool owned = true; /**< no earlier leg of the path runs here */
  };

  static constexpr double kStep = 3.0;

  /** \param[in,out] drive heights are evened out where legs meet
   * \param[in] height of the poses above the ground */
  TownPath(Trajectory& drive, double height);

  const std::vector<Node>&
  nodes() const
  {
    return nodes_;
  }

  /** Place on the ground at an arc length, metres to the left of the path. */
  Eigen::Vector3d
  place(double arc, double lateral) const;

  /** Direction of the path at an arc length. */
  Eigen::Vector2d
  direction(double arc) const;

  /** Arc length of the drive at a time (that of the nearest pose's time beyond the
   * ends). */
  double
  arcAt(double time) const;

  /** Whether the road between a node and the next is to be built. */
  bool
  hasRoad(std::size_t node) const
  {
    return nodes_[node].owned || nodes_[node + 1].owned;
  }

  /** Distance of a place from the nearest road's edge, negative on a road; at most
   * kFar. */
  double
  roadClearance(const Eigen::Vector2d& place) const;

  /** Distance of a place from the nearest line driven; at most kFar. */
  double
  driveClearance(const Eigen::Vector2d& place) const;

  /** Smooth height of the ground, and how far the nearest node is. */
  struct Ground {
    double height = 0.0;
    double distance = 0.0;
  };

  Ground
  groundAt(const Eigen::Vector2d& place) const;

  static constexpr double kFar = 64.0;

private:
  void
  placeNodes(const Trajectory& drive, double height);

  void
  setDirections();

  /** A node near one of an earlier leg, and how much their heights have to agree. */
  struct Meeting {
    std::size_t node;
    std::size_t earlier;
    double weight;
  };

  std::vector<Meeting>
  findMeetings();

  std::vector<double>
  evenedHeights(const std::vector<Meeting>& meetings) const;

  void
  evenHeights(Trajectory& drive, double height);

  Eigen::Vector2d
  middle(std::size_t node) const;

  static std::uint64_t
  cellKey(std::int64_t x, std::int64_t y)
  {
    return static_cast<std::uint64_t>(x) << 32U ^
           (static_cast<std::uint64_t>(y) & 0xFFFFFFFFU);
  }

  static std::int64_t
  cellOf(double coordinate)
  {
    return static_cast<std::int64_t>(std::floor(coordinate / kFar));
  }

  /** Calls \a visit with all nodes within kFar of a place, and some more. */
  template <typename Visit>
  void
  visitNear(const Eigen::Vector2d& place, const Visit& visit) const;

  std::vector<Node> nodes_;
  std::vector<double> pose_arc_;
  std::vector<double> pose_time_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

template <typename Visit>
void
TownPath::visitNear(const Eigen::Vector2d& place, const Visit& visit) const
{
  for (std::int64_t dx = -1; dx <= 1; ++dx)
    for (std::int64_t dy = -1; dy <= 1; ++dy) {
      const auto cell =
          cells_.find(cellKey(cellOf(place.x()) + dx, cellOf(place.y()) + dy));
      if (cell == cells_.end())
        continue;
      for (const std::uint32_t node : cell->second)
        visit(node);
    }
}

} // namespace nurbs
} // namespace pcl
