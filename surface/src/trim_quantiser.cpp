// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "coded_trim.h"

#include <optional>

namespace pcl {
namespace nurbs {
namespace {

using Corners = std::vector<Eigen::Vector2d>;
using Domains = std::array<KnotVector, 2>;

constexpr double kMaxLatticeCells = 1 << 20;
constexpr int kMaxRefinements = 8;

bool
isPolyline(const NurbsCurve2& curve)
{
  return curve.degree() == 1 && !curve.isRational() && curve.knots().isClamped() &&
         static_cast<int>(curve.knots().breaks().size()) == curve.numControlPoints();
}

/** Corners of a loop of straight edges, first corner not repeated. */
Corners
straightCorners(const TrimLoop& loop)
{
  Corners corners;
  for (const NurbsCurve2& curve : loop.curves())
    for (int i = 0; i + 1 < curve.numControlPoints(); ++i)
      corners.push_back(curve.controlPoint(i));
  return corners;
}

bool
isEqual(const TrimLoop& a, const TrimLoop& b)
{
  if (a.curves().size() != b.curves().size())
    return false;
  for (std::size_t i = 0; i < a.curves().size(); ++i)
    if (a.curves()[i].knots() != b.curves()[i].knots() ||
        a.curves()[i].homogeneousPoints() != b.curves()[i].homogeneousPoints())
      return false;
  return true;
}

/** Greatest common divisor of lengths that are multiples of one up to rounding. */
double
commonDivisor(double a, double b, double rounding)
{
  if (a <= rounding)
    return b;
  while (b > rounding) {
    const double rest = std::abs(a - std::nearbyint(a / b) * b);
    a = b;
    b = rest;
  }
  return a;
}

/** The lattice that a coordinate of the corners lies on, if there is one that is not
 * too fine. */
std::optional<TrimLattice>
cornerLattice(const Corners& corners, int direction, const KnotVector& knots)
{
  double low = corners.front()(direction);
  double high = low;
  for (const Eigen::Vector2d& corner : corners) {
    low = std::min(low, corner(direction));
    high = std::max(high, corner(direction));
  }
  const double rounding = 1e-9 * (high - low);
  double spacing = 0.0;
  for (const Eigen::Vector2d& corner : corners)
    spacing = commonDivisor(corner(direction) - low, spacing, rounding);
  if (!(spacing > 0.0) || (high - low) / spacing > kMaxLatticeCells)
    return std::nullopt;
  TrimLattice lattice{0, low, spacing};
  const double cells = knots.domainLength() / spacing;
  const double before = (low - knots.domainMin()) / spacing;
  if (cells <= kMaxLatticeCells && std::abs(cells - std::nearbyint(cells)) < 1e-6 &&
      std::abs(before - std::nearbyint(before)) < 1e-6)
    lattice.cells = std::llround(cells);
  return lattice;
}

TrimLattice
latticeFor(const Corners& corners,
           int direction,
           const KnotVector& knots,
           double tolerance)
{
  const auto found = cornerLattice(corners, direction, knots);
  if (found && found->spacing >= 0.5 * tolerance)
    return *found;
  const double cells = std::ceil(knots.domainLength() / tolerance);
  return {cells > 1.0 ? static_cast<std::int64_t>(std::min(cells, 1e12)) : 1, 0.0, 1.0};
}

bool
placeCorners(const Corners& corners, const Domains& knots, CodedLoop& coded)
{
  for (const Eigen::Vector2d& corner : corners) {
    CodedLoop::Place place{};
    for (int d = 0; d < 2; ++d) {
      const TrimLattice& lattice = coded.lattice[d];
      const double first = lattice.cells > 0 ? knots[d].domainMin() : lattice.origin;
      const double spacing = lattice.cells > 0 ? knots[d].domainLength() /
                                                     static_cast<double>(lattice.cells)
                                               : lattice.spacing;
      if (!quantise(corner(d) - first, spacing, place[d]))
        return false;
    }
    coded.places.push_back(place);
  }
  return true;
}

/** Repeated corners say nothing about the area inside. */
void
dropRepeatedCorners(std::vector<CodedLoop::Place>& places)
{
  places.erase(std::unique(places.begin(), places.end()), places.end());
  while (places.size() > 1 && places.front() == places.back())
    places.pop_back();
}

/** Whether a formula gives the same bits where multiplication and addition are fused
 * into one rounding. */
bool
isSameEverywhere(const CodedLoop& coded)
{
  for (const CodedLoop::Place& place : coded.places)
    for (int d = 0; d < 2; ++d) {
      const TrimLattice& lattice = coded.lattice[d];
      const auto k = static_cast<double>(place[d]);
      if (lattice.cells == 0 && std::fma(k, lattice.spacing, lattice.origin) !=
                                    lattice.origin + k * lattice.spacing)
        return false;
    }
  return true;
}

std::optional<CodedLoop>
losslessPolygon(const TrimLoop& loop, const Corners& corners, const Domains& knots)
{
  CodedLoop coded;
  for (int d = 0; d < 2; ++d) {
    const auto lattice = cornerLattice(corners, d, knots[d]);
    if (!lattice)
      return std::nullopt;
    coded.lattice[d] = *lattice;
  }
  if (placeCorners(corners, knots, coded) && isSameEverywhere(coded) &&
      isEqual(coded.decoded(knots[0], knots[1]), loop))
    return coded;
  return std::nullopt;
}

/** Polygon on a lattice; empty if it would collapse or turn over on it. */
std::optional<CodedLoop>
quantisedPolygon(const TrimLoop& loop,
                 const Corners& corners,
                 const Domains& knots,
                 const Domains& coded_knots,
                 const std::array<double, 2>& tolerance)
{
  CodedLoop coded;
  for (int d = 0; d < 2; ++d)
    coded.lattice[d] = latticeFor(corners, d, knots[d], tolerance[d]);
  if (!placeCorners(corners, knots, coded))
    return std::nullopt;
  dropRepeatedCorners(coded.places);
  if (coded.places.size() < 3)
    return std::nullopt;
  const double area = coded.decoded(coded_knots[0], coded_knots[1]).signedArea();
  const double original = loop.signedArea();
  if (original != 0.0 && !(area * original > 0.0))
    return std::nullopt;
  return coded;
}

CodedLoop
exactPolygon(const Corners& corners)
{
  CodedLoop coded;
  coded.kind = CodedLoop::Kind::Corners;
  for (const Eigen::Vector2d& corner : corners)
    coded.corners.insert(coded.corners.end(), {corner.x(), corner.y()});
  return coded;
}

} // namespace

bool
hasStraightEdges(const TrimLoop& loop)
{
  return std::all_of(loop.curves().begin(), loop.curves().end(), isPolyline) &&
         straightCorners(loop).size() >= 3;
}

CodedLoop
codedLoop(const TrimLoop& loop,
          const Domains& knots,
          const Domains& coded_knots,
          const std::array<double, 2>& tolerance)
{
  const bool lossless = !(tolerance[0] > 0.0 && tolerance[1] > 0.0);
  const bool straight = hasStraightEdges(loop);
  const Corners corners = straight ? straightCorners(loop) : Corners();
  if (straight && lossless && isEqual(TrimLoop::polygon(corners), loop)) {
    const auto coded = losslessPolygon(loop, corners, knots);
    return coded ? *coded : exactPolygon(corners);
  }
  if (straight && !lossless) {
    std::array<double, 2> spacing = tolerance;
    for (int i = 0; i < kMaxRefinements; ++i) {
      if (auto coded = quantisedPolygon(loop, corners, knots, coded_knots, spacing))
        return *std::move(coded);
      spacing = {0.5 * spacing[0], 0.5 * spacing[1]};
    }
    return exactPolygon(corners);
  }
  CodedLoop coded;
  coded.kind = CodedLoop::Kind::Curves;
  coded.curves = loop.curves();
  static_cast<void>(coded.decoded(knots[0], knots[1])); // throws if it does not close
  return coded;
}

} // namespace nurbs
} // namespace pcl
