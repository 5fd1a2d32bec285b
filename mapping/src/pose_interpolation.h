// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/mapping/trajectory.h>

namespace pcl {
namespace nurbs {

/** Pose at a time by even motion from one pose to another, and on beyond them. */
inline Eigen::Isometry3d
interpolatePose(const StampedPose& from, const StampedPose& to, double time)
{
  const double span = to.stamp - from.stamp;
  const double share = span > 0.0 ? (time - from.stamp) / span : 0.0;
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(
      from.T_world_body.linear().transpose() * to.T_world_body.linear()));
  Eigen::Isometry3d pose = from.T_world_body;
  pose.linear() = from.T_world_body.linear() *
                  Eigen::AngleAxisd(share * turn.angle(), turn.axis()).matrix();
  pose.translation() +=
      share * (to.T_world_body.translation() - from.T_world_body.translation());
  return pose;
}

} // namespace nurbs
} // namespace pcl
