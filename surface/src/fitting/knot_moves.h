// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "group_testing.h"
#include "knot_model.h"
#include "sample_grid.h"

#include <pcl/surface/nurbs/fit_options.h>

#include <vector>

namespace pcl {
namespace nurbs {

/** \brief Parameter region of a group of bins. */
SalientRegion
salientRegion(const SampleGrid& samples, const BinGroup& group);

/** \brief Models one move away from a model. */
class KnotMoves {
public:
  /** All arguments must outlive this.
   * \param[in] samples binned points
   * \param[in] options limits
   * \param[in] model where moves start
   * \param[in] salient what the model leaves that does not look like noise */
  KnotMoves(const SampleGrid& samples,
            const KnotSearchOptions& options,
            const KnotModel& model,
            const std::vector<BinGroup>& salient)
      : samples_(samples), options_(options), model_(model), salient_(salient)
  {
  }

  /** \brief More knots where something is salient, or higher degrees. */
  std::vector<KnotModel>
  growth() const;

  /** \brief One knot or one degree less. */
  std::vector<KnotModel>
  shrink() const;

private:
  /** Add a knot in every span with salient energy, at the centre of that energy, or two
   * that split it in three; with \a strongest_only in the span that has most of it. */
  KnotAxis
  refined(const KnotAxis& axis, int dimension, int knots, bool strongest_only) const;

  bool
  allowed(const KnotAxis& axis, int fixed_degree) const;

  const SampleGrid& samples_;
  const KnotSearchOptions& options_;
  const KnotModel& model_;
  const std::vector<BinGroup>& salient_;
};

} // namespace nurbs
} // namespace pcl
