// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "coded_trim.h"

namespace pcl {
namespace nurbs {
namespace {

using Place = CodedLoop::Place;

constexpr double kLargestGap = 1e-3; // between curves, of the extent of the loop

Place
operator-(const Place& a, const Place& b)
{
  return {wrappingSubtract(a[0], b[0]), wrappingSubtract(a[1], b[1])};
}

Place
operator+(const Place& a, const Place& b)
{
  return {wrappingAdd(a[0], b[0]), wrappingAdd(a[1], b[1])};
}

/** Extent of all control points, the unit for gaps. */
double
extent(const std::vector<NurbsCurve2>& curves)
{
  double largest = 0.0;
  const Eigen::Vector2d start = curves.front().controlPoint(0);
  for (const NurbsCurve2& curve : curves)
    for (int i = 0; i < curve.numControlPoints(); ++i)
      largest =
          std::max(largest, (curve.controlPoint(i) - start).cwiseAbs().maxCoeff());
  return largest;
}

/** 0..3 for edges along +u, +v, -u, -v; -1 for others. */
int
headingOf(const Place& edge)
{
  if ((edge[0] == 0) == (edge[1] == 0))
    return -1;
  if (edge[1] == 0)
    return edge[0] > 0 ? 0 : 2;
  return edge[1] > 0 ? 1 : 3;
}

} // namespace

double
TrimLattice::at(const KnotVector& knots, std::int64_t place) const
{
  const auto k = static_cast<double>(place);
  if (cells > 0)
    return knots.domainMin() + knots.domainLength() * k / static_cast<double>(cells);
  return origin + k * spacing;
}

TrimLoop
CodedLoop::decoded(const KnotVector& knots_u, const KnotVector& knots_v) const
{
  if (kind == Kind::Curves) {
    require(!curves.empty(), "a trimming loop without curves");
    return TrimLoop(curves, kLargestGap * extent(curves));
  }
  std::vector<Eigen::Vector2d> points;
  for (const Place& place : places)
    points.emplace_back(lattice[0].at(knots_u, place[0]),
                        lattice[1].at(knots_v, place[1]));
  for (std::size_t i = 0; i + 1 < corners.size(); i += 2)
    points.emplace_back(corners[i], corners[i + 1]);
  return TrimLoop::polygon(points);
}

template <class Coder>
void
TrimCodec::codeLattice(Coder& coder, TrimLattice& lattice)
{
  cells_.code(coder, lattice.cells);
  require(lattice.cells >= 0, "a negative number of lattice cells");
  if (lattice.cells > 0)
    return;
  origin_.code(coder, lattice.origin);
  spacing_.code(coder, lattice.spacing);
}

template <class Coder>
void
TrimCodec::codeLattices(Coder& coder, std::array<TrimLattice, 2>& lattice)
{
  bool same = lattice == last_lattice_;
  coder.bit(same_lattice_, same);
  if (same) {
    lattice = last_lattice_;
    return;
  }
  for (TrimLattice& one : lattice)
    codeLattice(coder, one);
  last_lattice_ = lattice;
}

template <class Coder>
void
TrimCodec::codeEdge(Coder& coder, Place& edge)
{
  static constexpr std::array<int, 4> kTurnOfQuarters{Straight, Left, Back, Right};
  const int heading = headingOf(edge);
  int turn = heading < 0 ? static_cast<int>(Oblique)
                         : kTurnOfQuarters[(heading - heading_ + 4) % 4];
  turn_[turn_before_][last_turn_].code(coder, turn);
  require(turn >= 0 && turn < kTurns, "unknown turn of a trimming loop");
  turn_before_ = last_turn_;
  last_turn_ = turn;
  if (turn == Oblique) {
    oblique_.code(coder, edge[0]);
    oblique_.code(coder, edge[1]);
    return;
  }
  static constexpr std::array<int, kTurns> kQuartersOfTurn{0, 1, 3, 0, 2};
  heading_ = (heading_ + kQuartersOfTurn[turn]) % 4;
  const std::size_t along = heading_ % 2;
  const bool backwards = heading_ >= 2;
  const std::int64_t signed_length =
      backwards ? wrappingSubtract(0, edge[along]) : edge[along];
  auto run = static_cast<std::uint64_t>(signed_length) - 1;
  run_.code(coder, run);
  require(run < std::uint64_t{1} << 62, "an edge of a trimming loop is too long");
  const auto length = static_cast<std::int64_t>(run + 1);
  edge = {0, 0};
  edge[along] = backwards ? -length : length;
}

template <class Coder>
void
TrimCodec::codePlaces(Coder& coder, std::vector<Place>& places)
{
  Place before{0, 0};
  for (std::size_t i = 0; i < places.size(); ++i) {
    Place edge = places[i] - before;
    if (i == 0)
      for (std::int64_t& coordinate : edge)
        start_.code(coder, coordinate);
    else
      codeEdge(coder, edge);
    places[i] = before = before + edge;
  }
}

template <class Coder>
void
TrimCodec::codeCurve(Coder& coder, NurbsCurve2& curve, CodecBudget& budget)
{
  CodedKnots knots = codedKnots(curve.knots(), 0.0, true);
  knots_.code(coder, knots, budget);
  const KnotVector decoded = knots.decoded();
  charge<Coder>(budget, 3 * static_cast<std::uint64_t>(decoded.numControlPoints()));
  NurbsCurve2::HomogeneousPoints points = curve.homogeneousPoints();
  std::vector<double> values(points.data(), points.data() + points.size());
  values.resize(3 * static_cast<std::size_t>(decoded.numControlPoints()));
  point_.code(coder, values, 3);
  points = Eigen::Map<const NurbsCurve2::HomogeneousPoints>(
      values.data(), 3, decoded.numControlPoints());
  curve = NurbsCurve2(decoded, std::move(points));
}

template <class Coder>
void
TrimCodec::code(Coder& coder, CodedLoop& loop, CodecBudget& budget)
{
  kind_.code(coder, loop.kind);
  auto count = static_cast<std::uint64_t>(
      std::max({loop.places.size(), loop.corners.size() / 2, loop.curves.size()}));
  count_.code(coder, count);
  charge<Coder>(budget, count);
  charge<Coder>(budget, count); // each has two coordinates
  const auto size = static_cast<std::size_t>(count);
  if (loop.kind == CodedLoop::Kind::Lattice) {
    codeLattices(coder, loop.lattice);
    loop.places.resize(size);
    codePlaces(coder, loop.places);
  }
  else if (loop.kind == CodedLoop::Kind::Corners) {
    loop.corners.resize(2 * size);
    corner_.code(coder, loop.corners, 2);
  }
  else {
    charge<Coder>(budget, 14 * count); // what an empty curve takes
    loop.curves.resize(size);
    for (NurbsCurve2& curve : loop.curves)
      codeCurve(coder, curve, budget);
  }
}

template void
TrimCodec::code(RangeEncoder&, CodedLoop&, CodecBudget&);
template void
TrimCodec::code(RangeDecoder&, CodedLoop&, CodecBudget&);

} // namespace nurbs
} // namespace pcl
