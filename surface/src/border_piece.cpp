// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "border_piece.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {

Eigen::Vector2d
BorderPiece::parameter(double t) const
{
  const Eigen::Vector2d uv = curve_->evaluate(t);
  return {surface_->knotsU().clampToDomain(uv.x()),
          surface_->knotsV().clampToDomain(uv.y())};
}

Eigen::Vector3d
BorderPiece::position(double t) const
{
  const Eigen::Vector2d uv = parameter(t);
  return surface_->evaluate(uv.x(), uv.y());
}

double
BorderPiece::project(const Eigen::Vector3d& target, double guess) const
{
  constexpr int kMaxSteps = 20;
  double t = guess;
  for (int n = 0; n < kMaxSteps; ++n) {
    const std::vector<Eigen::Vector2d> c = curve_->derivatives(t, 1);
    const SurfaceJet1 jet = surface_->evaluateJet1(c[0].x(), c[0].y());
    const Eigen::Vector3d tangent = jet.du * c[1].x() + jet.dv * c[1].y();
    const double speed2 = tangent.squaredNorm();
    if (speed2 == 0.0)
      break;
    const double step = tangent.dot(target - jet.position) / speed2;
    const double next = std::clamp(t + step, first_, last_);
    const bool is_still = std::abs(next - t) <= 1e-15 * (last_ - first_);
    t = next;
    if (is_still)
      break;
  }
  return t;
}

double
BorderPiece::projectFromAnywhere(const Eigen::Vector3d& target) const
{
  constexpr int kStarts = 16;
  double best = first_;
  double best_distance = HUGE_VAL;
  for (int k = 0; k <= kStarts; ++k) {
    const double t = first_ + (last_ - first_) * k / kStarts;
    const double distance = (position(t) - target).squaredNorm();
    if (distance < best_distance) {
      best = t;
      best_distance = distance;
    }
  }
  return project(target, best);
}

} // namespace nurbs
} // namespace pcl
