// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/trimmed_surface.h>

#include "polygon_index.h"
#include "segment_distance.h"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace nurbs {
namespace {

constexpr double kBorderTolerance = 1e-12; // of the domain's diagonal
constexpr double kFlatteningError = 1e-6;  // of the domain's diagonal
constexpr int kMaxHalvings = 16;

Eigen::Vector2d
startOf(const NurbsCurve2& curve)
{
  return curve.evaluate(curve.knots().domainMin());
}

Eigen::Vector2d
endOf(const NurbsCurve2& curve)
{
  return curve.evaluate(curve.knots().domainMax());
}

NurbsCurve2
polyline(const std::vector<double>& breaks, const NurbsCurve2::Points& corners)
{
  return NurbsCurve2::fromControlPoints(KnotVector::clamped(1, breaks), corners);
}

/** Appends corners for the open parameter interval (first, last), increasing. */
void
flattenPiece(const NurbsCurve2& curve,
             double first,
             double last,
             double tolerance,
             int halvings,
             std::vector<Eigen::Vector2d>& corners)
{
  const Eigen::Vector2d from = curve.evaluate(first);
  const Eigen::Vector2d to = curve.evaluate(last);
  double error = 0.0;
  for (const double fraction : {0.25, 0.5, 0.75})
    error = std::max(error,
                     segmentDistance<2>(
                         curve.evaluate(first + fraction * (last - first)), from, to));
  if (error <= tolerance || halvings == 0)
    return;
  const double middle = 0.5 * (first + last);
  flattenPiece(curve, first, middle, tolerance, halvings - 1, corners);
  corners.push_back(curve.evaluate(middle));
  flattenPiece(curve, middle, last, tolerance, halvings - 1, corners);
}

void
flattenCurve(const NurbsCurve2& curve,
             double tolerance,
             std::vector<Eigen::Vector2d>& corners)
{
  const std::vector<double> breaks = curve.knots().breaks();
  // More starting pieces than inflections, so that no bend hides between the probes.
  const int pieces = curve.degree() == 1 ? 1 : curve.degree();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int k = 0; k < pieces; ++k) {
      const double step = (breaks[i + 1] - breaks[i]) / pieces;
      const double first = breaks[i] + k * step;
      corners.push_back(curve.evaluate(first));
      if (curve.degree() > 1)
        flattenPiece(curve, first, first + step, tolerance, kMaxHalvings, corners);
    }
}

/** Signed area between the straight pieces of a curve and the arms from the origin to
 * its ends. */
double
polygonSector(const NurbsCurve2& curve, const Eigen::Vector2d& origin)
{
  double sum = 0.0;
  Eigen::Vector2d arm = curve.controlPoint(0) - origin;
  for (int i = 1; i < curve.numControlPoints(); ++i) {
    const Eigen::Vector2d next = curve.controlPoint(i) - origin;
    sum += 0.5 * (arm.x() * next.y() - arm.y() * next.x());
    arm = next;
  }
  return sum;
}

} // namespace

TrimLoop::TrimLoop(std::vector<NurbsCurve2> curves, double closing_tolerance)
    : curves_(std::move(curves))
{
  if (curves_.empty())
    throw std::invalid_argument("TrimLoop: at least one curve is needed");
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const NurbsCurve2& next = curves_[(i + 1) % curves_.size()];
    if (!((endOf(curves_[i]) - startOf(next)).norm() <= closing_tolerance))
      throw std::invalid_argument("TrimLoop: curve " + std::to_string(i) +
                                  " does not end where the next one starts");
  }
}

TrimLoop
TrimLoop::polygon(const std::vector<Eigen::Vector2d>& corners)
{
  if (corners.size() < 3)
    throw std::invalid_argument("TrimLoop: a polygon needs three corners");
  const std::size_t n = corners.size();
  NurbsCurve2::Points points(2, static_cast<Eigen::Index>(n) + 1);
  std::vector<double> breaks(n + 1);
  for (std::size_t i = 0; i <= n; ++i) {
    points.col(static_cast<Eigen::Index>(i)) = corners[i % n];
    breaks[i] = static_cast<double>(i);
  }
  return TrimLoop({polyline(breaks, points)});
}

TrimLoop
TrimLoop::ofDomain(const NurbsSurface& surface)
{
  const double u0 = surface.knotsU().domainMin();
  const double u1 = surface.knotsU().domainMax();
  const double v0 = surface.knotsV().domainMin();
  const double v1 = surface.knotsV().domainMax();
  const auto side = [](double first, double last, Eigen::Matrix2d corners) {
    return polyline({first, last}, corners);
  };
  const NurbsCurve2 bottom =
      side(u0, u1, (Eigen::Matrix2d() << u0, u1, v0, v0).finished());
  const NurbsCurve2 right =
      side(v0, v1, (Eigen::Matrix2d() << u1, u1, v0, v1).finished());
  const NurbsCurve2 top =
      side(u0, u1, (Eigen::Matrix2d() << u1, u0, v1, v1).finished());
  const NurbsCurve2 left =
      side(v0, v1, (Eigen::Matrix2d() << u0, u0, v1, v0).finished());
  return TrimLoop({bottom, right, top, left});
}

std::vector<Eigen::Vector2d>
TrimLoop::flattened(double tolerance) const
{
  if (!(tolerance > 0.0))
    throw std::invalid_argument("TrimLoop: the tolerance must be positive");
  std::vector<Eigen::Vector2d> corners;
  for (const NurbsCurve2& curve : curves_)
    flattenCurve(curve, tolerance, corners);
  return corners;
}

double
TrimLoop::signedArea() const
{
  // Half the integral of x dy - y dx; the origin is moved to the loop, where its size
  // cannot cancel digits. Ten points are exact for polynomials of degree 19.
  const Eigen::Vector2d origin = startOf(curves_.front());
  double sum = 0.0;
  for (const NurbsCurve2& curve : curves_) {
    if (curve.knots().degree() == 1 && curve.knots().isClamped()) {
      sum += polygonSector(curve, origin); // weights do not bend straight pieces
      continue;
    }
    const auto integrand = [&](double t) {
      const std::vector<Eigen::Vector2d> c = curve.derivatives(t, 1);
      const Eigen::Vector2d arm = c[0] - origin;
      return 0.5 * (arm.x() * c[1].y() - arm.y() * c[1].x());
    };
    const std::vector<double> breaks = curve.knots().breaks();
    const int pieces = curve.isRational() ? 4 : 1;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      for (int k = 0; k < pieces; ++k) {
        const double step = (breaks[i + 1] - breaks[i]) / pieces;
        sum += boost::math::quadrature::gauss<double, 10>::integrate(
            integrand, breaks[i] + k * step, breaks[i] + (k + 1) * step);
      }
  }
  return sum;
}

TrimLoop
TrimLoop::reversed() const
{
  TrimLoop result(*this);
  std::reverse(result.curves_.begin(), result.curves_.end());
  for (NurbsCurve2& curve : result.curves_)
    curve = curve.reversed();
  return result;
}

TrimmedSurface::TrimmedSurface(NurbsSurface surface, std::vector<TrimLoop> loops)
    : surface_(std::move(surface)), loops_(std::move(loops))
{
  if (loops_.empty())
    return;
  const double diagonal =
      std::hypot(surface_.knotsU().domainLength(), surface_.knotsV().domainLength());
  std::vector<std::vector<Eigen::Vector2d>> polygons;
  polygons.reserve(loops_.size());
  for (const TrimLoop& loop : loops_)
    polygons.push_back(loop.flattened(kFlatteningError * diagonal));
  index_ = std::make_shared<const PolygonIndex>(polygons, kBorderTolerance * diagonal);
}

bool
TrimmedSurface::contains(double u, double v) const
{
  const auto isInside = [](const KnotVector& knots, double t) {
    const double tolerance = kBorderTolerance * knots.domainLength();
    return t >= knots.domainMin() - tolerance && t <= knots.domainMax() + tolerance;
  };
  return isInside(surface_.knotsU(), u) && isInside(surface_.knotsV(), v) &&
         (!index_ || index_->contains({u, v}));
}

} // namespace nurbs
} // namespace pcl
