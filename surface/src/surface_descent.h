// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/closest_point.h>

#include "distance_search.h"
#include "smooth_intervals.h"

#include <Eigen/Core>

namespace pcl {
namespace nurbs {

struct SquaredDistanceSlope;

/** \brief One descent from a start parameter to a local minimum of the distance between
 * a surface and a point. No allocation. */
class SurfaceDescent {
public:
  SurfaceDescent(const NurbsSurface& surface,
                 const SmoothIntervals& intervals_u,
                 const SmoothIntervals& intervals_v,
                 double size,
                 const Eigen::Vector3d& point,
                 const Eigen::Vector2d& start);

  void
  run();

  FootPoint
  foot() const
  {
    return {u_.value(), v_.value(), squared_, converged_};
  }

  ClosestPoint
  result() const;

private:
  void
  load(const SurfaceJet2& jet)
  {
    jet_ = jet;
    residual_ = jet.position - point_;
    squared_ = residual_.squaredNorm();
  }

  bool
  bend(const SquaredDistanceSlope& slope, Eigen::Vector2d& step) const;

  Eigen::Vector2d
  clamped(const Eigen::Vector2d& step) const;

  bool
  isLast(const Eigen::Vector2d& step, double squared_length, bool bent) const;

  SurfaceJet1
  taylor(const Eigen::Vector2d& step) const;

  bool
  tryStep(Eigen::Vector2d step);

  void
  finish(const Eigen::Vector2d& step);

  const NurbsSurface& surface_;
  Eigen::Vector3d point_;
  DescentParameter u_;
  DescentParameter v_;
  double size_;
  double no_step_;
  SurfaceJet2 jet_;
  Eigen::Vector3d residual_;
  double squared_;
  bool converged_ = false;
};

} // namespace nurbs
} // namespace pcl
