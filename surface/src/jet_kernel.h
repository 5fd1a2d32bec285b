// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <cstddef>

namespace pcl {
namespace nurbs {

/** \brief Where an evaluation reads a surface: plain arrays, so that code compiled for
 * particular processors shares no type with the rest of the program. */
struct PlainSpan {
  int p;                 /**< degree in u */
  int q;                 /**< degree in v */
  std::ptrdiff_t stride; /**< control points from one index i to the next */
  const double* knots_u; /**< at the last knot that is not above u */
  const double* knots_v; /**< the same for v */
  const double* points;  /**< homogeneous control point of the first functions */
};

/** \brief Rows of a jet: homogeneous coordinates of the point and its partial
 * derivatives, in this order. */
enum JetRow { kValue, kDu, kDv, kDuu, kDuv, kDvv, kJetRows };

/** \brief Tensor-product sums up to a total order of derivatives.
 * \param[in] at spans of u and v
 * \param[in] u first parameter
 * \param[in] v second parameter
 * \param[in] order 0, 1 or 2
 * \param[out] jet 1, 3 or 6 rows */
void
evaluatePlainJet(const PlainSpan& at, double u, double v, int order, double (*jet)[4]);

} // namespace nurbs
} // namespace pcl
