// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "border_agglomeration.h"
#include "border_fits.h"
#include "surface_joining.h"

#include <cmath>

namespace pcl {
namespace nurbs {
namespace {

/** Largest step (standard deviations) between the local fits of one surface. */
constexpr double kStepSigmas = 3.0;
/** Share of the common border that must be smooth. */
constexpr double kSmoothShare = 0.6;
/** A steady bend may be so much larger than a crease. */
constexpr double kBend = 1.5;

bool
isSmooth(const BorderFit& fit, double crease_angle)
{
  const double angle = fit.bends ? kBend * crease_angle : crease_angle;
  return fit.step <= kStepSigmas && fit.normal[0].dot(fit.normal[1]) >= std::cos(angle);
}

} // namespace

void
joinSmooth(const JoiningInput& input,
           const KeptEdges& edges,
           const FacetCells& cells,
           const std::vector<std::uint32_t>& parts,
           DisjointSets& surfaces)
{
  const auto pieces =
      keptBorders(
          input.points.geometry, edges, cells.facet, input.facets.count(), cells.size)
          .list();
  const BorderFitter fitter(
      input.points, input.chart, input.criterion, cells.facet, cells.size);
  std::vector<std::uint8_t> smooth(pieces.size());
#pragma omp parallel for schedule(dynamic, 16) num_threads(input.options.threads)
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto& [key, piece] = pieces[k];
    if (!parts.empty() && parts[key.a] != parts[key.b])
      continue;
    const std::optional<BorderFit> fit = fitter.at(key.a, key.b, piece.middle);
    smooth[k] = fit && isSmooth(*fit, input.options.crease_angle) ? 1 : 0;
  }
  BorderAgglomeration agglomeration(input.facets.count());
  for (std::size_t k = 0; k < pieces.size(); ++k)
    agglomeration.add(
        pieces[k].first.a, pieces[k].first.b, pieces[k].second.cells, smooth[k] != 0);
  agglomeration.joinInto(surfaces, kSmoothShare);
}

} // namespace nurbs
} // namespace pcl
