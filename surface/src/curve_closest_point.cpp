// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/closest_point.h>

#include "distance_search.h"
#include "smooth_intervals.h"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace pcl {
namespace nurbs {
namespace {

constexpr int kMaxIterations = 60;
constexpr int kMaxHalvings = 12;
constexpr double kNoStep = 1e-14; // share of the size of the curve

/** One descent to a local minimum of the distance to a curve. */
template <int Dim>
class CurveDescent {
public:
  using Point = typename NurbsCurve<Dim>::Point;

  CurveDescent(const NurbsCurve<Dim>& curve,
               const SmoothIntervals& intervals,
               double size,
               const Point& point,
               double start)
      : curve_(curve), point_(point), u_(intervals, start), no_step_(kNoStep * size)
  {
    load(u_.value());
  }

  void
  run()
  {
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      const double slope = residual_.dot(jet_[1]);
      if (u_.blocked(slope) && u_.hop(slope)) {
        load(u_.value());
        continue;
      }
      const double speed = jet_[1].squaredNorm();
      const double second = speed + residual_.dot(jet_[2]);
      const double step = -slope / (second > 0.0 ? second : speed + 1e-300);
      const double target = u_.clamp(u_.value() + step);
      converged_ = std::abs(target - u_.value()) * std::sqrt(speed) <= no_step_;
      if (converged_ || !tryStep(target - u_.value()))
        return;
    }
  }

  FootPoint
  foot() const
  {
    return {u_.value(), 0.0, residual_.squaredNorm(), converged_};
  }

  CurveClosestPoint<Dim>
  result() const
  {
    return {u_.value(), jet_[0], residual_.norm(), converged_, u_.atOpenEnd()};
  }

private:
  void
  load(double u)
  {
    jet_ = curve_.derivatives(u, 2);
    residual_ = jet_[0] - point_;
  }

  bool
  tryStep(double step)
  {
    const double limit = residual_.squaredNorm() * (1.0 + 1e-14);
    const double start = u_.value();
    for (int halving = 0; halving < kMaxHalvings; ++halving, step *= 0.5) {
      load(u_.clamp(start + step));
      if (residual_.squaredNorm() > limit)
        continue;
      u_.set(u_.clamp(start + step));
      return true;
    }
    load(start);
    return false;
  }

  const NurbsCurve<Dim>& curve_;
  Point point_;
  DescentParameter u_;
  double no_step_;
  std::vector<Point> jet_;
  Point residual_;
  bool converged_ = false;
};

template <int Dim>
bool
isClosed(const NurbsCurve<Dim>& curve, double tolerance)
{
  return (curve.evaluate(curve.knots().domainMin()) -
          curve.evaluate(curve.knots().domainMax()))
             .norm() <= tolerance;
}

} // namespace

template <int Dim>
struct CurveClosestPointFinder<Dim>::Impl {
  explicit Impl(NurbsCurve<Dim> c)
      : curve(std::move(c)),
        tree(extractBezier(curve)),
        intervals(curve.knots(), isClosed(curve, 1e-10 * tree.size()))
  {
  }

  CurveDescent<Dim>
  descend(const Point& point, double u) const
  {
    CurveDescent<Dim> descent(curve, intervals, tree.size(), point, u);
    descent.run();
    return descent;
  }

  NurbsCurve<Dim> curve;
  PatchTree tree;
  SmoothIntervals intervals;
};

template <int Dim>
CurveClosestPointFinder<Dim>::CurveClosestPointFinder(NurbsCurve<Dim> curve)
    : impl_(std::make_shared<const Impl>(std::move(curve)))
{
}

template <int Dim>
const NurbsCurve<Dim>&
CurveClosestPointFinder<Dim>::curve() const
{
  return impl_->curve;
}

template <int Dim>
CurveClosestPoint<Dim>
CurveClosestPointFinder<Dim>::find(const Point& point) const
{
  if (!point.allFinite())
    throw std::invalid_argument("CurveClosestPointFinder: the point is not finite");
  Eigen::Vector3d lifted = Eigen::Vector3d::Zero();
  lifted.template head<Dim>() = point;
  DistanceSearch search(impl_->tree, lifted, [this, &point](double u, double) {
    return impl_->descend(point, u).foot();
  });
  return impl_->descend(point, search.run().u).result();
}

template <int Dim>
CurveClosestPoint<Dim>
CurveClosestPointFinder<Dim>::findFrom(const Point& point, double u) const
{
  if (!point.allFinite() || !std::isfinite(u))
    throw std::invalid_argument(
        "CurveClosestPointFinder: the point or the start is not finite");
  return impl_->descend(point, u).result();
}

template <int Dim>
std::optional<double>
CurveClosestPointFinder<Dim>::invert(const Point& point, double tolerance) const
{
  const CurveClosestPoint<Dim> closest = find(point);
  if (!(closest.distance <= tolerance))
    return std::nullopt;
  return closest.u;
}

template class CurveClosestPointFinder<2>;
template class CurveClosestPointFinder<3>;

} // namespace nurbs
} // namespace pcl
