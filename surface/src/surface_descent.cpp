// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "surface_descent.h"

#include "regular_point.h"

#include <Eigen/Geometry>

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr int kMaxIterations = 60;
constexpr int kMaxHalvings = 12;

/** Newton steps shorter than this share of the surface end the descent: the error left
 * is of the order of their square. */
constexpr double kLastStep = 1e-7;

/** Lengths below this share of the surface count as none. */
constexpr double kNoStep = 1e-14;

} // namespace

/** First and second derivatives of half the squared distance (equation 6.5). */
struct SquaredDistanceSlope {
  SquaredDistanceSlope(const SurfaceJet2& s, const Eigen::Vector3d& residual)
      : u(residual.dot(s.du)),
        v(residual.dot(s.dv)),
        e(s.du.squaredNorm()),
        f(s.du.dot(s.dv)),
        g(s.dv.squaredNorm()),
        uu(e + residual.dot(s.duu)),
        uv(f + residual.dot(s.duv)),
        vv(g + residual.dot(s.dvv))
  {
  }

  double u, v;
  double e, f, g;
  double uu, uv, vv;
};

namespace {

/** Newton step in the free parameters, Gauss-Newton where the Hessian is not safely
 * positive. */
Eigen::Vector2d
descentStep(const SquaredDistanceSlope& slope, bool free_u, bool free_v)
{
  constexpr double kSingular = 1e-10;
  const double damping = 1e-12 * (slope.e + slope.g) + 1e-300;
  if (free_u && free_v) {
    const double product = slope.uu * slope.vv;
    double det = product - slope.uv * slope.uv;
    if (slope.uu > 0.0 && det > kSingular * product)
      return Eigen::Vector2d(slope.uv * slope.v - slope.vv * slope.u,
                             slope.uv * slope.u - slope.uu * slope.v) /
             det;
    const double e = slope.e + damping;
    const double g = slope.g + damping;
    det = e * g - slope.f * slope.f;
    return Eigen::Vector2d(slope.f * slope.v - g * slope.u,
                           slope.f * slope.u - e * slope.v) /
           det;
  }
  Eigen::Vector2d step = Eigen::Vector2d::Zero();
  if (free_u)
    step.x() = -slope.u / (slope.uu > 0.0 ? slope.uu : slope.e + damping);
  if (free_v)
    step.y() = -slope.v / (slope.vv > 0.0 ? slope.vv : slope.g + damping);
  return step;
}

/** Steepest descent, scaled per parameter: decreases the distance also where borders
 * cut off parts of it, which a Newton step need not do. */
Eigen::Vector2d
gradientStep(const SquaredDistanceSlope& slope)
{
  return {-slope.u / (slope.e + 1e-300), -slope.v / (slope.g + 1e-300)};
}

} // namespace

SurfaceDescent::SurfaceDescent(const NurbsSurface& surface,
                               const SmoothIntervals& intervals_u,
                               const SmoothIntervals& intervals_v,
                               double size,
                               const Eigen::Vector3d& point,
                               const Eigen::Vector2d& start)
    : surface_(surface),
      point_(point),
      u_(intervals_u, start.x()),
      v_(intervals_v, start.y()),
      last_step_(kLastStep * size),
      no_step_(kNoStep * size)
{
  load(surface_.evaluateJet2(u_.value(), v_.value()));
}

void
SurfaceDescent::run()
{
  for (int iteration = 0; iteration < kMaxIterations && !converged_; ++iteration) {
    const SquaredDistanceSlope slope(jet_, residual_);
    if (hopped(slope))
      continue;
    Eigen::Vector2d step =
        descentStep(slope, !u_.blocked(slope.u), !v_.blocked(slope.v));
    step.x() = u_.clamp(u_.value() + step.x()) - u_.value();
    step.y() = v_.clamp(v_.value() + step.y()) - v_.value();
    const double length = (step.x() * jet_.du + step.y() * jet_.dv).norm();
    constexpr double kShare = 1e-3; // where a pole makes length tell nothing
    if (length <= no_step_)
      converged_ = true;
    else if (length <= last_step_ && std::abs(step.x()) <= kShare * u_.length() &&
             std::abs(step.y()) <= kShare * v_.length())
      finish(step);
    else if (!tryStep(step) && !tryStep(gradientStep(slope)))
      return;
  }
}

bool
SurfaceDescent::hopped(const SquaredDistanceSlope& slope)
{
  const bool moved = (u_.blocked(slope.u) && u_.hop(slope.u)) ||
                     (v_.blocked(slope.v) && v_.hop(slope.v));
  if (moved)
    load(surface_.evaluateJet2(u_.value(), v_.value()));
  return moved;
}

/** Take the step or the first of its halves that does not increase the distance. */
bool
SurfaceDescent::tryStep(Eigen::Vector2d step)
{
  const double limit = squared_ * (1.0 + 1e-14);
  for (int halving = 0; halving < kMaxHalvings; ++halving, step *= 0.5) {
    const double u = u_.clamp(u_.value() + step.x());
    const double v = v_.clamp(v_.value() + step.y());
    const SurfaceJet2 jet = surface_.evaluateJet2(u, v);
    if ((jet.position - point_).squaredNorm() > limit)
      continue;
    if (step.x() != 0.0)
      u_.set(u);
    if (step.y() != 0.0)
      v_.set(v);
    load(jet);
    return true;
  }
  return false;
}

/** Take a last, tiny step by the Taylor polynomial instead of another evaluation. */
void
SurfaceDescent::finish(const Eigen::Vector2d& step)
{
  const double a = step.x();
  const double b = step.y();
  jet_.position += a * jet_.du + b * jet_.dv + 0.5 * a * a * jet_.duu +
                   a * b * jet_.duv + 0.5 * b * b * jet_.dvv;
  residual_ = jet_.position - point_;
  squared_ = residual_.squaredNorm();
  u_.set(u_.clamp(u_.value() + a));
  v_.set(v_.clamp(v_.value() + b));
  converged_ = true;
}

ClosestPoint
SurfaceDescent::result() const
{
  ClosestPoint result;
  result.u = u_.value();
  result.v = v_.value();
  result.point = jet_.position;
  result.distance = std::sqrt(squared_);
  Eigen::Vector3d normal = unitNormal(surface_, jet_.du, jet_.dv);
  if (normal.isZero())
    normal = surface_.normal(result.u, result.v);
  result.signed_distance = -residual_.dot(normal);
  result.converged = converged_;
  result.at_boundary = u_.atOpenEnd() || v_.atOpenEnd();
  return result;
}

} // namespace nurbs
} // namespace pcl
