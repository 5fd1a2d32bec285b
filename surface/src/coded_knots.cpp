// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "coded_knots.h"

#include <optional>

namespace pcl {
namespace nurbs {
namespace {

using Layout = CodedKnots::Layout;

constexpr int kMaxLatticeBits = 40;

/** Largest distance of corresponding knots, both domains mapped to [0, 1]. */
double
relativeDeviation(const KnotVector& a, const KnotVector& b)
{
  double deviation = 0.0;
  for (int i = 0; i < a.size(); ++i)
    deviation = std::max(deviation,
                         std::abs((a[i] - a.domainMin()) / a.domainLength() -
                                  (b[i] - b.domainMin()) / b.domainLength()));
  return deviation;
}

bool
represents(const CodedKnots& coded, const KnotVector& knots, double tolerance)
{
  const KnotVector decoded = coded.decoded();
  return tolerance > 0.0 ? relativeDeviation(decoded, knots) <= tolerance
                         : decoded == knots;
}

void
roundDomain(CodedKnots& coded, double tolerance)
{
  const double first = roundedToTolerance(coded.first, tolerance);
  const double last = roundedToTolerance(coded.last, tolerance);
  if (last - first > 8.0 * tolerance) {
    coded.first = first;
    coded.last = last;
  }
}

/** Interior knots on a lattice of 2^bits cells, if they stay apart on it. */
std::optional<std::vector<std::int64_t>>
latticePlaces(const KnotVector& knots, int bits, double relative_tolerance)
{
  const double cells = std::ldexp(1.0, bits);
  std::vector<std::int64_t> places;
  std::int64_t before = 0;
  for (int i = knots.degree() + 1; i < knots.numControlPoints(); ++i) {
    const double place = (knots[i] - knots.domainMin()) / knots.domainLength() * cells;
    const std::int64_t nearest = std::llround(place);
    const bool same_as_before = knots[i] == knots[i - 1];
    if (std::abs(place - static_cast<double>(nearest)) > relative_tolerance * cells ||
        (nearest == before) != same_as_before || nearest >= std::int64_t{1} << bits)
      return std::nullopt;
    places.push_back(before = nearest);
  }
  return places;
}

bool
placeOnLattice(const KnotVector& knots, double relative_tolerance, CodedKnots& coded)
{
  for (int bits = 1; bits <= kMaxLatticeBits; ++bits)
    if (auto places = latticePlaces(knots, bits, relative_tolerance)) {
      coded.layout = Layout::Lattice;
      coded.lattice_bits = bits;
      coded.places = std::move(*places);
      return true;
    }
  return false;
}

} // namespace

KnotVector
CodedKnots::decoded() const
{
  if (layout == Layout::Exact)
    return {degree, exact};
  if (layout == Layout::UniformUnclamped)
    return KnotVector::periodicUniform(degree, spans, first, last);
  if (layout == Layout::UniformClamped)
    return KnotVector::clampedUniform(degree, spans, first, last);
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, first);
  for (std::int64_t place : places)
    knots.push_back(first + (last - first) *
                                std::ldexp(static_cast<double>(place), -lattice_bits));
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, last);
  return {degree, std::move(knots)};
}

CodedKnots
codedKnots(const KnotVector& knots, double tolerance, bool keep_domain)
{
  CodedKnots coded;
  coded.degree = knots.degree();
  coded.first = knots.domainMin();
  coded.last = knots.domainMax();
  coded.spans = knots.size() - 2 * knots.degree() - 1;
  const double relative = tolerance > 0.0 ? tolerance / knots.domainLength() : 0.0;
  if (tolerance > 0.0 && !keep_domain)
    roundDomain(coded, tolerance);
  // Without a tolerance a formula may round differently elsewhere: only a single span,
  // which needs no arithmetic, is worth more than the knots themselves.
  const bool formula_allowed = tolerance > 0.0 || coded.spans == 1;
  for (Layout layout : {Layout::UniformClamped, Layout::UniformUnclamped}) {
    coded.layout = layout;
    if (formula_allowed && represents(coded, knots, relative) &&
        (layout == Layout::UniformClamped || tolerance > 0.0))
      return coded;
  }
  if (tolerance > 0.0 && knots.isClamped() && placeOnLattice(knots, relative, coded))
    return coded;
  coded.layout = Layout::Exact;
  coded.exact = knots.values();
  return coded;
}

template <class Coder>
void
KnotCodec::codeLattice(Coder& coder, CodedKnots& knots, CodecBudget& budget)
{
  lattice_bits_.code(coder, knots.lattice_bits);
  require(knots.lattice_bits >= 0 && knots.lattice_bits <= kMaxLatticeBits,
          "knot lattice too fine");
  auto count = static_cast<std::uint64_t>(knots.places.size());
  count_.code(coder, count);
  charge<Coder>(budget, count);
  knots.places.resize(static_cast<std::size_t>(count));
  std::int64_t before = 0;
  for (std::int64_t& place : knots.places) {
    auto step = static_cast<std::uint64_t>(place - before);
    place_step_.code(coder, step);
    require(step <= std::uint64_t{1} << kMaxLatticeBits, "knot outside of the lattice");
    place = before + static_cast<std::int64_t>(step);
    require(place < std::int64_t{1} << knots.lattice_bits,
            "knot outside of the domain");
    before = place;
  }
}

template <class Coder>
void
KnotCodec::code(Coder& coder, CodedKnots& knots, CodecBudget& budget)
{
  degree_.code(coder, knots.degree);
  require(knots.degree >= 1 && knots.degree <= kMaxDegree, "degree out of range");
  layout_.code(coder, knots.layout);
  if (knots.layout == Layout::Exact) {
    auto count = static_cast<std::uint64_t>(knots.exact.size());
    count_.code(coder, count);
    charge<Coder>(budget, count);
    knots.exact.resize(static_cast<std::size_t>(count));
    exact_.code(coder, knots.exact, 1);
    return;
  }
  first_.code(coder, knots.first);
  last_.code(coder, knots.last);
  if (knots.layout == Layout::Lattice) {
    codeLattice(coder, knots, budget);
    return;
  }
  auto spans = static_cast<std::uint64_t>(knots.spans);
  count_.code(coder, spans);
  charge<Coder>(budget, spans);
  require(spans >= 1 && spans <= 1U << 30, "number of spans out of range");
  knots.spans = static_cast<int>(spans);
}

template void
KnotCodec::code(RangeEncoder&, CodedKnots&, CodecBudget&);
template void
KnotCodec::code(RangeDecoder&, CodedKnots&, CodecBudget&);

} // namespace nurbs
} // namespace pcl
