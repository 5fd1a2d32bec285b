// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "surface_criterion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace nurbs {

SurfaceCriterion::SurfaceCriterion(const ViewChart& chart,
                                   const SurfaceGroupingOptions& options,
                                   double dispersion)
    : chart_(chart), options_(options), dispersion_(dispersion)
{
}

double
SurfaceCriterion::penalty(int terms, double samples) const
{
  const double k = terms;
  switch (options_.criterion) {
  case GroupingCriterion::AIC:
    return k;
  case GroupingCriterion::AICc:
    // Without enough samples the term is as large as it ever gets.
    return k + k * (k + 1.0) / std::max(samples - k - 1.0, 1.0);
  case GroupingCriterion::BIC:
    return 0.5 * k * std::log(std::max(samples, 2.0));
  case GroupingCriterion::DescriptionLength:
    break;
  }
  return options_.patch_cost + options_.coefficient_cost * k;
}

double
SurfaceCriterion::borderSaving(double pixels) const
{
  return options_.criterion == GroupingCriterion::DescriptionLength
             ? 2.0 * options_.border_cost * pixels
             : 0.0;
}

CostedModel
SurfaceCriterion::best(const ViewSums& sums, int most) const
{
  const double samples = sums.count() / dispersion_;
  const double weight = 0.5 / dispersion_;
  ViewFit fit(sums);
  int chosen = 0;
  CostedModel best;
  best.cost = std::numeric_limits<double>::infinity();
  for (const int terms : chart_.termChoices()) {
    const double fixed = penalty(terms, samples);
    if (chosen != 0 &&
        (terms > most || fixed >= best.cost || sums.count() < 2.0 * terms))
      break; // even a perfect fit would not pay
    const double misfit = fit.misfit(terms);
    const double cost = fixed + weight * misfit;
    if (chosen == 0 || cost < best.cost) {
      chosen = terms;
      best.misfit = misfit;
      best.cost = cost;
    }
  }
  best.surface = fit.solve(chosen);
  return best;
}

double
SurfaceCriterion::meanSquare(const ViewSums& sums, const ViewPolynomial& surface) const
{
  return sums.misfit(surface) / std::max(sums.count(), 1.0);
}

bool
SurfaceCriterion::fits(const ViewSums& sums,
                       const ViewPolynomial& surface,
                       double own_misfit) const
{
  constexpr double kAsOwn = 1.5;
  const double own = own_misfit / std::max(sums.count(), 1.0);
  const double limit =
      std::max(options_.fit_sigmas * options_.fit_sigmas, kAsOwn * own);
  return meanSquare(sums, surface) <= limit;
}

std::optional<CostedModel>
SurfaceCriterion::merged(const ViewSums& a,
                         const CostedModel& model_a,
                         const ViewSums& b,
                         const CostedModel& model_b,
                         double border,
                         double& saving) const
{
  ViewSums both = a;
  both += b;
  CostedModel model = best(both);
  saving = model_a.cost + model_b.cost + borderSaving(border) - model.cost;
  if (!(saving > 0.0) || !fits(a, model.surface, model_a.misfit) ||
      !fits(b, model.surface, model_b.misfit))
    return std::nullopt;
  return model;
}

} // namespace nurbs
} // namespace pcl
