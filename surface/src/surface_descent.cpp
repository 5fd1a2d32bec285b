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

/** Steps bent by the curvature of the surface leave an error of the order of their
 * square times the distance or their length, whichever is larger; the descent ends
 * where that is below this share of the cubed size. */
constexpr double kLastBentError = 1e-14;

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
        vv(g + residual.dot(s.dvv)),
        det(uu * vv - uv * uv)
  {
  }

  /** Whether the Hessian is safely positive. */
  bool
  isConvex() const
  {
    constexpr double kSingular = 1e-10;
    return uu > 0.0 && det > kSingular * uu * vv;
  }

  /** Newton step to where the slope \a u, \a v vanishes. */
  Eigen::Vector2d
  newtonStep(double slope_u, double slope_v) const
  {
    return Eigen::Vector2d(uv * slope_v - vv * slope_u, uv * slope_u - uu * slope_v) /
           det;
  }

  /** Squared length of a step on the surface. */
  double
  squaredLength(const Eigen::Vector2d& step) const
  {
    return e * step.x() * step.x() + 2.0 * f * step.x() * step.y() +
           g * step.y() * step.y();
  }

  double u, v;
  double e, f, g;
  double uu, uv, vv;
  double det;
};

namespace {

/** Newton step in the free parameters, Gauss-Newton where the Hessian is not safely
 * positive. */
Eigen::Vector2d
descentStep(const SquaredDistanceSlope& slope, bool free_u, bool free_v)
{
  const double damping = 1e-12 * (slope.e + slope.g) + 1e-300;
  if (free_u && free_v) {
    if (slope.isConvex())
      return slope.newtonStep(slope.u, slope.v);
    const double e = slope.e + damping;
    const double g = slope.g + damping;
    const double det = e * g - slope.f * slope.f;
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
      size_(size),
      no_step_(kNoStep * size)
{
  load(surface_.evaluateJet2(u_.value(), v_.value()));
}

void
SurfaceDescent::run()
{
  for (int iteration = 0; iteration < kMaxIterations && !converged_; ++iteration) {
    const SquaredDistanceSlope slope(jet_, residual_);
    const bool free_u = !u_.blocked(slope.u);
    const bool free_v = !v_.blocked(slope.v);
    if ((!free_u && u_.hop(slope.u)) || (!free_v && v_.hop(slope.v))) {
      load(surface_.evaluateJet2(u_.value(), v_.value()));
      continue;
    }
    Eigen::Vector2d step = descentStep(slope, free_u, free_v);
    const bool bent = free_u && free_v && slope.isConvex() && bend(slope, step);
    step = clamped(step);
    const double squared_length = std::max(slope.squaredLength(step), 0.0);
    if (squared_length <= no_step_ * no_step_)
      converged_ = true;
    else if (isLast(step, squared_length, bent))
      finish(step);
    else if (!tryStep(step) && !tryStep(gradientStep(slope)))
      return;
  }
}

/** Correct a Newton step by the slope that the Taylor polynomial of the surface has at
 * its end: most of another iteration without another evaluation.
 * \return whether it is corrected and stays inside of its intervals */
bool
SurfaceDescent::bend(const SquaredDistanceSlope& slope, Eigen::Vector2d& step) const
{
  const SurfaceJet1 end = taylor(step);
  const Eigen::Vector3d residual = end.position - point_;
  const Eigen::Vector2d correction =
      slope.newtonStep(residual.dot(end.du), residual.dot(end.dv));
  if (!(slope.squaredLength(correction) <= 0.1 * slope.squaredLength(step)))
    return false; // too far for the polynomial
  step += correction;
  const double u = u_.value() + step.x();
  const double v = v_.value() + step.y();
  return u_.clamp(u) == u && v_.clamp(v) == v;
}

Eigen::Vector2d
SurfaceDescent::clamped(const Eigen::Vector2d& step) const
{
  return {u_.clamp(u_.value() + step.x()) - u_.value(),
          v_.clamp(v_.value() + step.y()) - v_.value()};
}

/** Whether what is left after the step is negligible. */
bool
SurfaceDescent::isLast(const Eigen::Vector2d& step,
                       double squared_length,
                       bool bent) const
{
  constexpr double kShare = 1e-3; // where a pole makes length tell nothing
  if (std::abs(step.x()) > kShare * u_.length() ||
      std::abs(step.y()) > kShare * v_.length())
    return false;
  if (squared_length <= kLastStep * kLastStep * size_ * size_)
    return true;
  // The polynomial must hold across knots as well.
  return bent && u_.curvatureIsContinuous() && v_.curvatureIsContinuous() &&
         squared_length * std::sqrt(std::max(squared_, squared_length)) <=
             kLastBentError * size_ * size_ * size_;
}

/** Point and first derivatives that the present Taylor polynomial has after a step. */
SurfaceJet1
SurfaceDescent::taylor(const Eigen::Vector2d& step) const
{
  const double a = step.x();
  const double b = step.y();
  const Eigen::Vector3d bend_u = a * jet_.duu + b * jet_.duv;
  const Eigen::Vector3d bend_v = a * jet_.duv + b * jet_.dvv;
  return {jet_.position + a * (jet_.du + 0.5 * bend_u) + b * (jet_.dv + 0.5 * bend_v),
          jet_.du + bend_u,
          jet_.dv + bend_v};
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
  const SurfaceJet1 end = taylor(step);
  jet_.position = end.position;
  jet_.du = end.du;
  jet_.dv = end.dv;
  residual_ = jet_.position - point_;
  squared_ = residual_.squaredNorm();
  u_.set(u_.clamp(u_.value() + step.x()));
  v_.set(v_.clamp(v_.value() + step.y()));
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
