// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include "match_pairs.h"

namespace pcl {
namespace nurbs {

/** The scatter of a loss's gradient about zero, from pairs in space whose errors are
 * correlated with those of their neighbours.
 *
 * Pairs are summed per cell of the target, and products of neighbouring cells count
 * with Bartlett's weights (Conley, J. Econometrics 92, 1999): errors of a plane in the
 * target are shared by all pairs within twice its extent, those of nearest points by
 * fewer. */
class GradientScatter {
public:
  GradientScatter(const MatchPairs& pairs,
                  const ScanPoints& scan,
                  const RobustKernel& kernel,
                  double cell_size);

  /** Scatter in the span of some tangents, corrected for the number of cells. */
  Eigen::MatrixXd
  in(const Eigen::MatrixXd& basis) const;

private:
  struct Cell {
    Eigen::Vector3i place;
    Tangent gradient = Tangent::Zero();
    /** Of the normal equations. */
    TangentMatrix weight = TangentMatrix::Zero();
  };

  /** Two cells that are the same or neighbours, and how much their product counts. */
  struct Neighbours {
    std::size_t first;
    std::size_t second;
    double weight;
  };

  /** The number of cells of equal weight whose scatter would be as certain. */
  double
  effectiveCount(const Eigen::MatrixXd& basis) const;

  std::vector<Cell> cells_;
  std::vector<Neighbours> neighbours_;
};

} // namespace nurbs
} // namespace pcl
