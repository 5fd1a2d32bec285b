// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/surface_model.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace pcl {
namespace nurbs {

/** \brief OBJ text that holds no surfaces we can read; what() gives line and reason. */
class PCL_NURBS_SURFACE_EXPORT ObjIoError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief A model as free-form surfaces of Wavefront OBJ (`cstype rat bspline`).
 *
 * Kept: knots, control points, weights, trimming curves, labels (as groups `label_N`).
 * Lost: frame, metadata, quality. Numbers have the digits that give them back exactly;
 * points are Cartesian, so weighted points may differ by one rounding.
 * Counter-clockwise loops become `trim`, clockwise ones `hole`. */
PCL_NURBS_SURFACE_EXPORT std::string
toObj(const SurfaceModel& model);

/** \brief The B-spline surfaces of an OBJ text.
 *
 * Meshes, curves in space, names and materials are skipped. Surfaces and trimming
 * curves must be used over their whole domain.
 * \param[in] text untrusted
 * \throws ObjIoError naming the line that is wrong */
PCL_NURBS_SURFACE_EXPORT SurfaceModel
fromObj(std::string_view text);

/** \brief Write toObj(); nothing appears under \a path before it is complete.
 * \throws std::runtime_error if the file cannot be written */
PCL_NURBS_SURFACE_EXPORT void
writeObjFile(const std::string& path, const SurfaceModel& model);

/** \brief Read a file for fromObj().
 * \throws ObjIoError naming the file if it cannot be read or is wrong */
PCL_NURBS_SURFACE_EXPORT SurfaceModel
readObjFile(const std::string& path);

} // namespace nurbs
} // namespace pcl
