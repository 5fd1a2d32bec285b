// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "cell_equations.h"
#include "knot_model.h"
#include "sample_grid.h"

#include <pcl/surface/nurbs/fit_options.h>

namespace pcl {
namespace nurbs {

/** \brief Fits models to samples and says what they are worth. */
class KnotTrials {
public:
  /** \param[in] samples binned points; must outlive this
   * \param[in] noise stated standard deviation of a value of unit weight, 0 if unknown
   * \param[in] options limits and criterion; must outlive this */
  KnotTrials(const SampleGrid& samples, double noise, const KnotSearchOptions& options);

  /** \brief Fit a model and set its criterion; it stays infinite if the model cannot be
   * fitted. */
  void
  evaluate(KnotModel& model) const;

  /** \brief Standard deviation by which residuals are judged. */
  double
  noise() const
  {
    return noise_;
  }

private:
  PointRows
  sampleRows(const CellPoints& points) const;

  const SampleGrid& samples_;
  const KnotSearchOptions& options_;
  double stated_;
  double floor_;
  double noise_;
};

} // namespace nurbs
} // namespace pcl
