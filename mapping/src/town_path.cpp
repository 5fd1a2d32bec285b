// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "town_path.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kEndPiece = 90.0;  // metres beyond the first and the last pose
constexpr double kLeastMove = 0.02; // less is standing still

double
distanceToSegment(const Vector2d& place, const Vector2d& a, const Vector2d& b)
{
  const Vector2d edge = b - a;
  const double length = edge.squaredNorm();
  const double share = length > 0.0 ? (place - a).dot(edge) / length : 0.0;
  return (place - a - std::min(1.0, std::max(0.0, share)) * edge).norm();
}

Vector2d
leftOf(const Vector2d& along)
{
  return {-along.y(), along.x()};
}

} // namespace

TownPath::TownPath(Trajectory& drive, double height)
{
  placeNodes(drive, height);
  setDirections();
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    cells_[cellKey(cellOf(nodes_[i].ground.x()), cellOf(nodes_[i].ground.y()))]
        .push_back(static_cast<std::uint32_t>(i));
  evenHeights(drive, height);
}

/** Nodes at equal steps of horizontal path; the ends go on straight and level. */
void
TownPath::placeNodes(const Trajectory& drive, double height)
{
  std::vector<Vector3d> corners;
  std::vector<double> arcs;
  for (const StampedPose& pose : drive) {
    const Vector3d ground =
        pose.T_world_body.translation() - height * Vector3d::UnitZ();
    const double move =
        corners.empty() ? 0.0 : (ground - corners.back()).head<2>().norm();
    if (corners.empty() || move > kLeastMove) {
      arcs.push_back(corners.empty() ? kEndPiece : arcs.back() + move);
      corners.push_back(ground);
    }
    pose_arc_.push_back(arcs.back());
    pose_time_.push_back(pose.stamp);
  }
  // Directions of the ends over some metres, or the sensor's own without any motion.
  const auto direction = [&](std::size_t end, int step) {
    std::size_t other = end;
    while (std::abs(arcs[other] - arcs[end]) < kStep &&
           (step > 0 ? other + 1 < corners.size() : other > 0))
      other += static_cast<std::size_t>(step);
    const Vector2d way = (corners[end] - corners[other]).head<2>();
    const Vector2d ahead = drive.front().T_world_body.linear().col(0).head<2>();
    const Vector2d fallback =
        ahead.norm() > 0.1 ? ahead.normalized() : Vector2d::UnitX();
    return Vector2d(way.norm() > kLeastMove ? way.normalized() : -step * fallback);
  };
  const Vector2d before = direction(0, 1);
  const Vector2d after = direction(corners.size() - 1, -1);
  const auto extended = [](const Vector3d& from, const Vector2d& way) {
    return Vector3d(
        from.x() + kEndPiece * way.x(), from.y() + kEndPiece * way.y(), from.z());
  };
  corners.insert(corners.begin(), extended(corners.front(), before));
  arcs.insert(arcs.begin(), 0.0);
  corners.push_back(extended(corners.back(), after));
  arcs.push_back(arcs.back() + kEndPiece);
  std::size_t corner = 0;
  for (double arc = 0.0; arc <= arcs.back(); arc += kStep) {
    while (corner + 2 < arcs.size() && arcs[corner + 1] < arc)
      ++corner;
    const double share = (arc - arcs[corner]) / (arcs[corner + 1] - arcs[corner]);
    Node node;
    node.ground = corners[corner] + share * (corners[corner + 1] - corners[corner]);
    node.arc = arc;
    nodes_.push_back(node);
  }
}

void
TownPath::setDirections()
{
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& before = nodes_[i > 0 ? i - 1 : i];
    const Node& after = nodes_[std::min(i + 1, nodes_.size() - 1)];
    const Vector2d way = (after.ground - before.ground).head<2>();
    if (way.norm() > kLeastMove)
      nodes_[i].along = way.normalized();
    else if (i > 0)
      nodes_[i].along = nodes_[i - 1].along;
  }
}

Vector3d
TownPath::place(double arc, double lateral) const
{
  const double clamped = std::min(std::max(arc, 0.0), nodes_.back().arc);
  const auto i = std::min(static_cast<std::size_t>(clamped / kStep), nodes_.size() - 2);
  const double share = clamped / kStep - static_cast<double>(i);
  Vector3d result = (1.0 - share) * nodes_[i].ground + share * nodes_[i + 1].ground;
  result.head<2>() += lateral * leftOf(direction(arc));
  return result;
}

Vector2d
TownPath::direction(double arc) const
{
  const double clamped = std::min(std::max(arc, 0.0), nodes_.back().arc);
  const auto i = std::min(static_cast<std::size_t>(clamped / kStep), nodes_.size() - 2);
  const double share = clamped / kStep - static_cast<double>(i);
  const Vector2d mean = (1.0 - share) * nodes_[i].along + share * nodes_[i + 1].along;
  return mean.norm() > 1e-6 ? Vector2d(mean.normalized()) : nodes_[i].along;
}

double
TownPath::arcAt(double time) const
{
  const auto after = std::upper_bound(pose_time_.begin(), pose_time_.end(), time);
  if (after == pose_time_.begin())
    return pose_arc_.front();
  if (after == pose_time_.end())
    return pose_arc_.back();
  const auto k = static_cast<std::size_t>(after - pose_time_.begin());
  const double share = (time - pose_time_[k - 1]) / (pose_time_[k] - pose_time_[k - 1]);
  return pose_arc_[k - 1] + share * (pose_arc_[k] - pose_arc_[k - 1]);
}

Vector2d
TownPath::middle(std::size_t node) const
{
  return nodes_[node].ground.head<2>() +
         RoadShape::kMiddle * leftOf(nodes_[node].along);
}

double
TownPath::roadClearance(const Vector2d& place) const
{
  double nearest = kFar;
  visitNear(place, [&](std::size_t i) {
    if (i + 1 < nodes_.size() && hasRoad(i))
      nearest = std::min(nearest,
                         distanceToSegment(place, middle(i), middle(i + 1)) -
                             RoadShape::kHalfWidth);
  });
  return nearest;
}

double
TownPath::driveClearance(const Vector2d& place) const
{
  double nearest = kFar;
  visitNear(place, [&](std::size_t i) {
    if (i + 1 < nodes_.size())
      nearest = std::min(nearest,
                         distanceToSegment(place,
                                           nodes_[i].ground.head<2>(),
                                           nodes_[i + 1].ground.head<2>()));
  });
  return nearest;
}

TownPath::Ground
TownPath::groundAt(const Vector2d& place) const
{
  Ground result{0.0, 2.0 * kFar};
  double weights = 0.0;
  visitNear(place, [&](std::size_t i) {
    const double square = (nodes_[i].ground.head<2>() - place).squaredNorm();
    const double weight = 1.0 / ((square + 4.0) * (square + 4.0));
    weights += weight;
    result.height += weight * nodes_[i].ground.z();
    result.distance = std::min(result.distance, std::sqrt(square));
  });
  if (weights > 0.0)
    result.height /= weights;
  return result;
}

} // namespace nurbs
} // namespace pcl
