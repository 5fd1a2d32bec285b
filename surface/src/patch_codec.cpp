// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors
//
// Patches of one section of a .nurbs file as one range-coded stream.

#include <pcl/surface/nurbs/nurbs_file.h>

#include "coded_net.h"
#include "coded_trim.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

constexpr std::uint64_t kNumbersPerPatch = 64;

struct CodedPatch {
  std::array<CodedKnots, 2> knots;
  CodedNet net;
  std::vector<CodedLoop> loops;
  std::uint32_t label = 0;
  PatchQuality quality;
};

/** Metres per unit of the parameter, at most: over all neighbours in the net. */
double
fastest(const NurbsSurface& surface, const GrevilleGrid& greville, int direction)
{
  double speed = 0.0;
  const int step_u = direction == 0 ? 1 : 0;
  const int step_v = 1 - step_u;
  const std::vector<double>& abscissae = greville.values[direction];
  for (int i = step_u; i < surface.numControlPointsU(); ++i)
    for (int j = step_v; j < surface.numControlPointsV(); ++j) {
      const int k = direction == 0 ? i : j;
      const double width = abscissae[k] - abscissae[k - 1];
      if (width > 0.0)
        speed = std::max(
            speed,
            (surface.controlPoint(i, j) - surface.controlPoint(i - step_u, j - step_v))
                    .norm() /
                width);
    }
  return speed;
}

/** Five significant bits: quality is a report, not a measurement to go on with. */
double
roundedQuality(double value)
{
  return value > 0.0 && std::isfinite(value)
             ? roundedToTolerance(value, std::ldexp(value, -4))
             : value;
}

CodedPatch
losslessPatch(const SurfacePatch& patch)
{
  const NurbsSurface& surface = patch.geometry.surface();
  const std::array<KnotVector, 2> knots{surface.knotsU(), surface.knotsV()};
  CodedPatch coded;
  for (int d = 0; d < 2; ++d)
    coded.knots[d] = codedKnots(knots[d], 0.0, true);
  coded.net = exactNet(surface);
  for (const TrimLoop& loop : patch.geometry.loops())
    coded.loops.push_back(codedLoop(loop, knots, knots, {0.0, 0.0}));
  coded.quality = patch.quality;
  return coded;
}

CodedPatch
quantisedPatch(const SurfacePatch& patch, double step, double trim_step)
{
  const NurbsSurface& surface = patch.geometry.surface();
  const std::vector<TrimLoop>& loops = patch.geometry.loops();
  const std::array<KnotVector, 2> knots{surface.knotsU(), surface.knotsV()};
  const GrevilleGrid greville(knots[0], knots[1]);
  // Curves are kept as they are, so the domain that they were made for is, too.
  const bool keep_domain = !std::all_of(loops.begin(), loops.end(), hasStraightEdges);
  CodedPatch coded;
  std::array<KnotVector, 2> coded_knots;
  std::array<double, 2> trim_spacing{};
  for (int d = 0; d < 2; ++d) {
    const double length = knots[d].domainLength();
    // A patch that has shrunk to a curve or point needs its parameters no finer.
    const double speed = std::max(fastest(surface, greville, d), step / length);
    coded.knots[d] = codedKnots(knots[d], 0.25 * step / speed, keep_domain);
    coded_knots[d] = coded.knots[d].decoded();
    trim_spacing[d] = trim_step / speed;
  }
  coded.net = quantisedNet(
      surface, greville, GrevilleGrid(coded_knots[0], coded_knots[1]), step);
  for (const TrimLoop& loop : loops)
    coded.loops.push_back(codedLoop(loop, knots, coded_knots, trim_spacing));
  coded.quality = {patch.quality.points,
                   roundedQuality(patch.quality.noise),
                   roundedQuality(patch.quality.rmse),
                   roundedQuality(patch.quality.max)};
  return coded;
}

SurfacePatch
decodedPatch(const CodedPatch& coded)
{
  const KnotVector knots_u = coded.knots[0].decoded();
  const KnotVector knots_v = coded.knots[1].decoded();
  auto points = std::visit(
      [&](const auto& net) { return net.decoded(GrevilleGrid(knots_u, knots_v)); },
      coded.net);
  std::vector<TrimLoop> loops;
  for (const CodedLoop& loop : coded.loops)
    loops.push_back(loop.decoded(knots_u, knots_v));
  return {TrimmedSurface(NurbsSurface(knots_u, knots_v, std::move(points)),
                         std::move(loops)),
          coded.label,
          coded.quality};
}

/** Models of everything in a section. */
class PatchCodec {
public:
  template <class Coder>
  void
  code(Coder& coder, CodedPatch& patch, CodecBudget& budget)
  {
    charge<Coder>(budget, kNumbersPerPatch);
    for (int d = 0; d < 2; ++d)
      knots_[d].code(coder, patch.knots[d], budget);
    const KnotVector u = patch.knots[0].decoded();
    const KnotVector v = patch.knots[1].decoded();
    charge<Coder>(budget,
                  static_cast<std::uint64_t>(u.numControlPoints()) *
                      static_cast<std::uint64_t>(v.numControlPoints()));
    net_.code(coder, patch.net, GrevilleGrid(u, v));
    auto loops = static_cast<std::uint64_t>(patch.loops.size());
    loops_.code(coder, loops);
    charge<Coder>(budget, loops);
    charge<Coder>(budget,
                  kNumbersPerPatch / 2 * std::min<std::uint64_t>(loops, 1 << 24));
    patch.loops.resize(static_cast<std::size_t>(loops));
    for (CodedLoop& loop : patch.loops)
      trims_.code(coder, loop, budget);
    codeIdentity(coder, patch);
  }

private:
  template <class Coder>
  void
  codeIdentity(Coder& coder, CodedPatch& patch)
  {
    std::int64_t label = patch.label;
    codeDifference(coder, label_, label, last_label_);
    require(label >= 0 && label <= 0xFFFFFFFF, "label out of range");
    patch.label = static_cast<std::uint32_t>(label);
    last_label_ = label;
    auto points = static_cast<std::int64_t>(patch.quality.points);
    points_.code(coder, points);
    patch.quality.points = static_cast<std::uint64_t>(points);
    noise_.code(coder, patch.quality.noise);
    rmse_.code(coder, patch.quality.rmse);
    max_.code(coder, patch.quality.max);
  }

  std::array<KnotCodec, 2> knots_;
  NetCodec net_;
  UnsignedModel loops_;
  TrimCodec trims_;
  SignedModel label_;
  std::int64_t last_label_ = 0;
  SignedModel points_;
  DoubleModel noise_;
  DoubleModel rmse_;
  DoubleModel max_;
};

} // namespace

void
NurbsFileOptions::validate() const
{
  if (!(rmse_share > 0.0) || !(rmse_share <= 10.0))
    throw std::invalid_argument("NurbsFileOptions: rmse_share is not in (0, 10]");
  if (!(step >= 0.0) || !std::isfinite(step))
    throw std::invalid_argument("NurbsFileOptions: step is negative or not finite");
  if (!(default_step > 0.0) || !std::isfinite(default_step))
    throw std::invalid_argument("NurbsFileOptions: default_step is not positive");
  if (!(trim_factor > 0.0) || !std::isfinite(trim_factor))
    throw std::invalid_argument("NurbsFileOptions: trim_factor is not positive");
}

double
NurbsFileOptions::stepFor(const PatchQuality& quality) const
{
  if (step > 0.0)
    return step;
  const double factor =
      std::sqrt(5.0 * ((1.0 + rmse_share) * (1.0 + rmse_share) - 1.0));
  for (double error : {quality.rmse, quality.noise})
    if (error > 0.0 && std::isfinite(error))
      return factor * error;
  return default_step;
}

std::vector<std::uint8_t>
encodePatches(const std::vector<SurfacePatch>& patches, const NurbsFileOptions& options)
{
  options.validate();
  RangeEncoder encoder;
  UnsignedModel count;
  PatchCodec codec;
  CodecBudget budget(0); // encoding charges nothing
  auto number = static_cast<std::uint64_t>(patches.size());
  count.code(encoder, number);
  for (const SurfacePatch& patch : patches) {
    const double step = options.stepFor(patch.quality);
    CodedPatch coded = options.lossless
                           ? losslessPatch(patch)
                           : quantisedPatch(patch, step, options.trim_factor * step);
    coded.label = patch.label;
    codec.code(encoder, coded, budget);
  }
  return encoder.finish();
}

std::vector<SurfacePatch>
decodePatches(const std::vector<std::uint8_t>& bytes, std::uint64_t& numbers)
{
  RangeDecoder decoder(bytes.data(), bytes.size());
  UnsignedModel count;
  PatchCodec codec;
  CodecBudget budget(numbers);
  std::uint64_t number = 0;
  count.code(decoder, number);
  std::vector<SurfacePatch> patches; // grows with what the budget has paid for
  for (std::uint64_t i = 0; i < number; ++i) {
    CodedPatch coded;
    codec.code(decoder, coded, budget);
    patches.push_back(decodedPatch(coded));
  }
  numbers = budget.left();
  return patches;
}

} // namespace nurbs
} // namespace pcl
