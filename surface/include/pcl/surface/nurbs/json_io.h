// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/surface_model.h>

#include <stdexcept>
#include <string>
#include <string_view>

namespace pcl {
namespace nurbs {

/** \brief JSON that is no surface model; what() gives the JSON path and the reason. */
class PCL_NURBS_SURFACE_EXPORT JsonIoError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief A model as JSON text, every number with the digits that give it back exactly.
 *
 * The layout is described in doc/file_format.md. Points are Cartesian (metres), so a
 * rational surface comes back with weighted points that may differ by one rounding. */
PCL_NURBS_SURFACE_EXPORT std::string
toJson(const SurfaceModel& model);

/** \brief Inverse of toJson(). Points may be nested in rows or follow each other.
 * \param[in] text untrusted
 * \throws JsonIoError naming the JSON path that is wrong */
PCL_NURBS_SURFACE_EXPORT SurfaceModel
fromJson(std::string_view text);

/** \brief Write toJson(); nothing appears under \a path before it is complete.
 * \throws std::runtime_error if the file cannot be written */
PCL_NURBS_SURFACE_EXPORT void
writeJsonFile(const std::string& path, const SurfaceModel& model);

/** \brief Read a file for fromJson().
 * \throws JsonIoError naming the file if it cannot be read or is wrong */
PCL_NURBS_SURFACE_EXPORT SurfaceModel
readJsonFile(const std::string& path);

} // namespace nurbs
} // namespace pcl
