// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/segmentation/surface_grouping.h>

#include <optional>

namespace pcl {
namespace nurbs {

/** The best model of some points and what it costs. */
struct CostedModel {
  ViewPolynomial surface;
  double misfit = 0.0; /**< sum of squares in units of the noise */
  double cost = 0.0;   /**< nats, borders not included */
};

/** What groups cost, by the options; in nats (half of AIC's and BIC's scale). */
class SurfaceCriterion {
public:
  /** \param[in] dispersion see noiseDispersion(): what the misfit is divided by */
  SurfaceCriterion(const ViewChart& chart,
                   const SurfaceGroupingOptions& options,
                   double dispersion);

  /** The number of terms of least cost; \a most bounds it. */
  CostedModel
  best(const ViewSums& sums, int most = kMostViewTerms) const;

  /** What is saved when \a pixels of border, of two groups each, vanish. */
  double
  borderSaving(double pixels) const;

  /** The misfit that costs so much. */
  double
  misfitWorth(double cost) const
  {
    return 2.0 * dispersion_ * cost;
  }

  /** Mean square residual in units of the noise. */
  double
  meanSquare(const ViewSums& sums, const ViewPolynomial& surface) const;

  /** Whether points are near a model, or as near as they are to their own. */
  bool
  fits(const ViewSums& sums, const ViewPolynomial& surface, double own_misfit) const;

  /** The model of two groups together; nothing when it costs more than both and their
   * border, or leaves one of them too far. \a saving is set to what is saved. */
  std::optional<CostedModel>
  merged(const ViewSums& a,
         const CostedModel& model_a,
         const ViewSums& b,
         const CostedModel& model_b,
         double border,
         double& saving) const;

private:
  double
  penalty(int terms, double samples) const;

  const ViewChart& chart_;
  SurfaceGroupingOptions options_;
  double dispersion_;
};

} // namespace nurbs
} // namespace pcl
