// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_surface.h>

#include <cstddef>

namespace pcl {
namespace nurbs {

/** \brief Three arrays for the coordinates of n points or vectors, owned by the caller.
 */
struct CoordinateArrays {
  double* x;
  double* y;
  double* z;
};

/** \brief Evaluate a surface at n parameters at once.
 *
 * The results are those of NurbsSurface::evaluate() to rounding, in any order of the
 * parameters. Four parameters share the basis functions in SIMD registers; processors
 * with AVX2 and FMA are recognised at run time. No allocation.
 * \param[in] surface surface
 * \param[in] n number of parameters
 * \param[in] u,v n parameters each
 * \param[out] points room for n points; must not overlap the parameters */
PCL_NURBS_SURFACE_EXPORT void
evaluateBatch(const NurbsSurface& surface,
              std::size_t n,
              const double* u,
              const double* v,
              const CoordinateArrays& points);

/** \brief Points and first derivatives at n parameters, as evaluateJet1(). */
PCL_NURBS_SURFACE_EXPORT void
evaluateJet1Batch(const NurbsSurface& surface,
                  std::size_t n,
                  const double* u,
                  const double* v,
                  const CoordinateArrays& points,
                  const CoordinateArrays& du,
                  const CoordinateArrays& dv);

/** \brief Points and unit normals at n parameters, as NurbsSurface::normal(): limits at
 * poles, zero where there is none. */
PCL_NURBS_SURFACE_EXPORT void
evaluateNormalBatch(const NurbsSurface& surface,
                    std::size_t n,
                    const double* u,
                    const double* v,
                    const CoordinateArrays& points,
                    const CoordinateArrays& normals);

} // namespace nurbs
} // namespace pcl
