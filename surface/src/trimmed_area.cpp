// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include <pcl/surface/nurbs/trimmed_surface.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl {
namespace nurbs {
namespace {

using Rule = boost::math::quadrature::gauss<double, 4>;

/** Integral of \a f over [first, last], cut at \a breaks and each part into \a pieces.
 */
template <typename Function>
double
integrate(const Function& f,
          const std::vector<double>& breaks,
          double first,
          double last,
          int pieces)
{
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double low = std::max(first, breaks[i]);
    const double step = (std::min(last, breaks[i + 1]) - low) / pieces;
    for (int k = 0; k < pieces && step > 0.0; ++k)
      sum += Rule::integrate(f, low + k * step, low + (k + 1) * step);
  }
  return sum;
}

/** Appends where coordinate \a axis of the curve takes one of \a values in an interval
 * in which it is as good as monotonic. */
void
appendCrossings(const NurbsCurve2& curve,
                Eigen::Index axis,
                const std::vector<double>& values,
                double first,
                double last,
                std::vector<double>& crossings)
{
  constexpr int kBisections = 50;
  const double at_first = curve.evaluate(first)(axis);
  const double at_last = curve.evaluate(last)(axis);
  const auto [low, high] = std::minmax(at_first, at_last);
  auto value = std::upper_bound(values.begin(), values.end(), low);
  for (; value != values.end() && *value < high; ++value) {
    double below = at_first < at_last ? first : last;
    double above = at_first < at_last ? last : first;
    for (int k = 0; k < kBisections; ++k) {
      const double middle = 0.5 * (below + above);
      (curve.evaluate(middle)(axis) < *value ? below : above) = middle;
    }
    crossings.push_back(above);
  }
}

/** Knots of the curve and where it crosses a knot line of the surface: between them
 * everything is smooth. */
std::vector<double>
smoothIntervals(const NurbsCurve2& curve,
                const std::vector<double>& breaks_u,
                const std::vector<double>& breaks_v)
{
  std::vector<double> breaks = curve.knots().breaks();
  const std::size_t spans = breaks.size() - 1;
  const int parts = curve.degree() == 1 ? 1 : 4 * curve.degree();
  for (std::size_t i = 0; i < spans; ++i)
    for (int k = 0; k < parts; ++k) {
      const double step = (breaks[i + 1] - breaks[i]) / parts;
      const double first = breaks[i] + k * step;
      appendCrossings(curve, 0, breaks_u, first, first + step, breaks);
      appendCrossings(curve, 1, breaks_v, first, first + step, breaks);
    }
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

/** Green's theorem: with G(u, v) the integral of |S_u x S_v| from the least u to u at
 * constant v, the area is the integral of G dv over the loops. */
double
integrateLoops(const NurbsSurface& surface,
               const std::vector<TrimLoop>& loops,
               const std::vector<double>& breaks_u,
               int pieces)
{
  const auto inner = [&](double u, double v) {
    const auto speed = [&](double s) {
      const SurfaceJet1 jet = surface.evaluateJet1(s, v);
      return jet.du.cross(jet.dv).norm();
    };
    return integrate(speed, breaks_u, breaks_u.front(), u, pieces);
  };
  const std::vector<double> breaks_v = surface.knotsV().breaks();
  double sum = 0.0;
  for (const TrimLoop& loop : loops)
    for (const NurbsCurve2& curve : loop.curves()) {
      const auto flux = [&](double t) {
        const std::vector<Eigen::Vector2d> c = curve.derivatives(t, 1);
        return c[1].y() == 0.0 ? 0.0 : inner(c[0].x(), c[0].y()) * c[1].y();
      };
      const std::vector<double> breaks = smoothIntervals(curve, breaks_u, breaks_v);
      sum += integrate(flux, breaks, breaks.front(), breaks.back(), pieces);
    }
  return std::abs(sum);
}

} // namespace

double
TrimmedSurface::area(double relative_tolerance) const
{
  if (!(relative_tolerance > 0.0))
    throw std::invalid_argument("TrimmedSurface: the tolerance must be positive");
  const std::vector<TrimLoop> whole =
      isTrimmed() ? std::vector<TrimLoop>() : std::vector{TrimLoop::ofDomain(surface_)};
  const std::vector<TrimLoop>& loops = isTrimmed() ? loops_ : whole;
  const std::vector<double> breaks_u = surface_.knotsU().breaks();
  constexpr int kMaxPieces = 64;
  double area = integrateLoops(surface_, loops, breaks_u, 1);
  for (int pieces = 2; pieces <= kMaxPieces; pieces *= 2) {
    const double refined = integrateLoops(surface_, loops, breaks_u, pieces);
    const bool converged = std::abs(refined - area) <= relative_tolerance * refined;
    area = refined;
    if (converged)
      break;
  }
  return area;
}

} // namespace nurbs
} // namespace pcl
