// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the PCL-NURBS authors

#include "surface_output.h"

#include "run_tool.h"

#include <pcl/surface/nurbs/json_io.h>
#include <pcl/surface/nurbs/mesh_io.h>
#include <pcl/surface/nurbs/obj_io.h>
#include <pcl/surface/nurbs/tessellation.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace pcl_nurbs_tools {
namespace {

pcl::nurbs::TriangleMesh
mesh(const pcl::nurbs::SurfaceModel& model, const SurfaceOutputOptions& options)
{
  pcl::nurbs::TessellationOptions tessellation;
  tessellation.chord_tolerance = options.mesh_tolerance > 0.0
                                     ? options.mesh_tolerance
                                     : suitableMeshTolerance(model);
  return pcl::nurbs::tessellate(model, tessellation);
}

} // namespace

const std::vector<std::string>&
surfaceExtensions()
{
  static const std::vector<std::string> extensions{".nurbs", ".json", ".obj", ".ply"};
  return extensions;
}

std::string
extensionOf(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(),
                 extension.end(),
                 extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

double
suitableMeshTolerance(const pcl::nurbs::SurfaceModel& model)
{
  Eigen::AlignedBox3d box;
  double squares = 0.0;
  double points = 0.0;
  for (const pcl::nurbs::SurfacePatch& patch : model.patches) {
    const auto count = static_cast<double>(patch.quality.points);
    squares += count * patch.quality.rmse * patch.quality.rmse;
    points += count;
    for (const pcl::nurbs::TrimLoop& loop : patch.geometry.loops())
      for (const pcl::nurbs::NurbsCurve2& curve : loop.curves())
        for (const double t : curve.knots().breaks()) {
          const Eigen::Vector2d uv = curve.evaluate(t);
          box.extend(patch.geometry.surface().evaluate(uv.x(), uv.y()));
        }
  }
  const double distance = points > 0.0 ? std::sqrt(squares / points) : 0.0;
  return std::max(0.5 * distance, box.diagonal().norm() / 20000.0);
}

void
writeSurfaces(const std::string& path,
              const pcl::nurbs::SurfaceModel& model,
              const SurfaceOutputOptions& options)
{
  const std::string extension = extensionOf(path);
  try {
    if (extension == ".nurbs")
      pcl::nurbs::writeNurbsFile(path, model, options.nurbs);
    else if (extension == ".json")
      pcl::nurbs::writeJsonFile(path, model);
    else if (extension == ".ply")
      pcl::nurbs::writePlyMesh(path, mesh(model, options));
    else if (extension == ".obj" && options.obj_rational)
      pcl::nurbs::writeObjFile(path, model);
    else if (extension == ".obj")
      pcl::nurbs::writeObjMesh(path, mesh(model, options));
    else
      throw std::logic_error("unknown extension");
  } catch (const std::logic_error& error) { // the format cannot hold the surfaces
    throw ToolError(kCannotWrite, "cannot write " + path + ": " + error.what());
  } catch (const std::runtime_error& error) {
    throw ToolError(kCannotWrite, error.what());
  }
}

} // namespace pcl_nurbs_tools
