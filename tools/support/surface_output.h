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
  double mesh_tolerance = 0.0; /**< chord tolerance of meshes, metres; 0: what suits */
  bool obj_rational = false;   /**< .obj holds rational surfaces, not a mesh */
};

/** Extensions that writeSurfaces() knows, with the dot. */
const std::vector<std::string>&
surfaceExtensions();

/** Extension of a path in lower case, with the dot. */
std::string
extensionOf(const std::string& path);

/** Chord tolerance that loses nothing: half of the points' distances from their
 * patches, but no less than 1/20000 of the model's size, which no picture would show.
 */
double
suitableMeshTolerance(const pcl::nurbs::SurfaceModel& model);

/** Write a model; the format follows from the extension, one of surfaceExtensions().
 * \throws ToolError(kCannotWrite) naming file and reason */
void
writeSurfaces(const std::string& path,
              const pcl::nurbs::SurfaceModel& model,
              const SurfaceOutputOptions& options);

} // namespace pcl_nurbs_tools
