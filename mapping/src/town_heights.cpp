// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "town_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kSamePlace = 4.5;  // legs nearer than that share their road
constexpr double kNearPlace = 16.0; // legs nearer than that have much the same height
constexpr double kSteepest = 0.2;   // climb per metre
constexpr double kOtherLeg = 25.0;  // metres of path that make another leg

double
clampedTo(double most, double value)
{
  return std::min(most, std::max(-most, value));
}

} // namespace

/** Nodes of other legs nearby, and which nodes run on an earlier leg's road. */
std::vector<TownPath::Meeting>
TownPath::findMeetings()
{
  std::vector<Meeting> meetings;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    double nearest = kNearPlace;
    std::size_t partner = i;
    visitNear(nodes_[i].ground.head<2>(), [&](std::size_t other) {
      const double distance =
          (nodes_[other].ground - nodes_[i].ground).head<2>().norm();
      if (nodes_[i].arc - nodes_[other].arc > kOtherLeg && distance < nearest) {
        nearest = distance;
        partner = other;
      }
    });
    nodes_[i].owned = nearest >= kSamePlace;
    if (partner != i)
      meetings.push_back(
          {i,
           partner,
           std::min(1.0, (kNearPlace - nearest) / (kNearPlace - kSamePlace))});
  }
  return meetings;
}

/** Heights that agree where legs meet and climb along the path as measured, but no
 * steeper than streets do, by Gauss-Seidel sweeps. */
std::vector<double>
TownPath::evenedHeights(const std::vector<Meeting>& meetings) const
{
  constexpr int kSweeps = 4000;
  constexpr double kSmooth = 4.0; // against 1 for agreeing with the other leg
  constexpr double kOriginal = 1e-4;
  const std::size_t count = nodes_.size();
  std::vector<std::vector<std::pair<std::size_t, double>>> partners(count);
  for (const Meeting& meeting : meetings) {
    partners[meeting.node].emplace_back(meeting.earlier, meeting.weight);
    partners[meeting.earlier].emplace_back(meeting.node, meeting.weight);
  }
  std::vector<double> heights(count);
  std::vector<double> climbs(count - 1);
  for (std::size_t i = 0; i < count; ++i)
    heights[i] = nodes_[i].ground.z();
  for (std::size_t i = 0; i + 1 < count; ++i)
    climbs[i] = clampedTo(kSteepest * kStep, heights[i + 1] - heights[i]);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t i = 0; i < count; ++i) {
      double weight = kOriginal;
      double sum = kOriginal * nodes_[i].ground.z();
      const auto pull = [&](double value, double strength) {
        sum += strength * value;
        weight += strength;
      };
      if (i > 0)
        pull(heights[i - 1] + climbs[i - 1], kSmooth);
      if (i + 1 < count)
        pull(heights[i + 1] - climbs[i], kSmooth);
      for (const auto& [j, strength] : partners[i])
        pull(heights[j], strength);
      heights[i] = sum / weight;
    }
  return heights;
}

/** The poses keep their place above the nodes, save for leaps. */
void
TownPath::evenHeights(Trajectory& drive, double height)
{
  constexpr double kBump = 0.15;
  const std::vector<Meeting> meetings = findMeetings();
  bool steep = false;
  for (std::size_t i = 0; i + 1 < nodes_.size(); ++i)
    steep = steep || std::abs(nodes_[i + 1].ground.z() - nodes_[i].ground.z()) >
                         kSteepest * kStep;
  if (meetings.empty() && !steep)
    return;
  const std::vector<double> heights = evenedHeights(meetings);
  for (std::size_t k = 0; k < drive.size(); ++k) {
    const auto i =
        std::min(static_cast<std::size_t>(pose_arc_[k] / kStep), nodes_.size() - 2);
    const double share = pose_arc_[k] / kStep - static_cast<double>(i);
    const double before =
        (1.0 - share) * nodes_[i].ground.z() + share * nodes_[i + 1].ground.z();
    const double after = (1.0 - share) * heights[i] + share * heights[i + 1];
    double& z = drive[k].T_world_body.translation().z();
    z = after + height + clampedTo(kBump, z - height - before);
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    nodes_[i].ground.z() = heights[i];
}

} // namespace nurbs
} // namespace pcl
