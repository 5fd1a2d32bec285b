// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <cstddef>

namespace pcl {
namespace nurbs {

/** \brief A surface as plain arrays, for code compiled for other processors than the
 * rest of the library. */
struct PlainSurface {
  struct Knots {
    const double* values;
    int degree;
    int count;      // control points
    int first_span; // first and last non-empty span of the domain
    int last_span;
  };
  Knots u;
  Knots v;
  const double* points; // homogeneous, four doubles each
};

/** \brief Arrays that a batch reads and writes: element 3 k + c of \a out is coordinate
 * c of the point (k = 0), of S_u (1) and of S_v (2). */
struct PlainBatch {
  std::size_t n;
  const double* u;
  const double* v;
  double* out[9];
};

/** \brief Points (\a order 0) or points and first derivatives (1), by the widest
 * instructions the processor has. */
void
evaluatePlain(const PlainSurface& surface, const PlainBatch& batch, int order);

} // namespace nurbs
} // namespace pcl
