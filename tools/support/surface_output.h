// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#pragma once

#include <pcl/surface/nurbs/nurbs_file.h>
#include <pcl/surface/nurbs/surface_model.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_nurbs_tools {

/** How a model is written to files whose extension names the format. */
struct SurfaceOutputOptions {
  pcl::nurbs::NurbsFileOptions nurbs;
  double mesh_tolerance = 1e-3; /**< chord tolerance of meshes, metres */
  bool obj_rational = false;    /**< .obj holds rational surfaces, not a mesh */
};

/** Extensions that writeSurfaces() knows, with the dot. */
const std::vector<std::string>&
surfaceExtensions();

/** Extension of a path in lower case, with the dot. */
std::string
extensionOf(const std::string& path);

/** Write a model; the format follows from the extension, one of surfaceExtensions().
 * \throws ToolError(kCannotWrite) naming file and reason */
void
writeSurfaces(const std::string& path,
              const pcl::nurbs::SurfaceModel& model,
              const SurfaceOutputOptions& options);

} // namespace pcl_nurbs_tools
